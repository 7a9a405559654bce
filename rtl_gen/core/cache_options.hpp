// What a user chooses of a cache (rtl_gen/core/features/cache.cpp).
#pragma once

namespace hitpipe::rtl {

struct CacheOptions {
  static constexpr int least_kib = 2, most_kib = 64;

  int kib = 0;    ///< 0: there is none; or a power of two, 2..64
  int line = 64;  ///< bytes: 32, 64
  int ways = 8;   ///< 4, 8
};

}  // namespace hitpipe::rtl
