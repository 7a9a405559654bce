// What the registers of a core say of it, and its C header too, so that a driver sees whether they go together.
#pragma once

#include <cstdint>

#include "rtl_gen/core/core.hpp"

namespace hitpipe::rtl {

/// Bits, the lowest first. format: n 8, g 4, F 4, S 8, p 8. shape: rays 15, questions 1, levels 8, bits of a block's number 8.
/// ports: bits of a tag 8, bits of an address 8, bytes of a beat 7, then a bit each: rings, floats at the door,
/// weights, one multiplier for triangles, one identifier for all requests. Then the cache: 3, its KiB being 2^of that,
/// 0 for none, and a bit for lines of 32 bytes.
struct CoreIdentity {
  std::uint32_t format, shape, ports;
};

[[nodiscard]] CoreIdentity identity_of(const CoreOptions& options);

}  // namespace hitpipe::rtl
