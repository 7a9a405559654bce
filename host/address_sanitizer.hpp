// HITPIPE_ADDRESS_SANITIZER is defined where AddressSanitizer watches. GCC defines a macro then, Clang has a
// feature.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define HITPIPE_ADDRESS_SANITIZER
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define HITPIPE_ADDRESS_SANITIZER
#endif
#endif
