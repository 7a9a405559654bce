// What saturating_shift() must give, in plain integers: the product with a power of two, cut to the range.
#pragma once

#include <algorithm>
#include <cstdint>

namespace hitpipe::hls::plain {

constexpr std::int64_t least(int width) {
  return -(std::int64_t{1} << (width - 1));
}
constexpr std::int64_t most(int width) {
  return (std::int64_t{1} << (width - 1)) - 1;
}

/// x 2^e in `width` bits, for widths up to 40 and e below the width.
constexpr std::int64_t saturating_shift(std::int64_t x, int e, int width) {
  __extension__ using Wide = __int128;
  const Wide product = static_cast<Wide>(x) * (Wide{1} << e);
  return static_cast<std::int64_t>(std::clamp<Wide>(product, least(width), most(width)));
}

static_assert(saturating_shift(3, 1, 4) == 6 && saturating_shift(-4, 1, 4) == -8);
static_assert(saturating_shift(4, 1, 4) == 7 && saturating_shift(-5, 1, 4) == -8);
static_assert(saturating_shift(0, 3, 4) == 0 && saturating_shift(-1, 3, 4) == -8);

/// Near the ends of the range the shift decides between a number and saturation: +-2^k, their neighbours, and
/// the ends.
template <class Visit>
void for_each_corner(int width, Visit&& visit) {
  for (int k = 0; k < width; ++k) {
    for (const std::int64_t sign : {1, -1}) {
      for (int beside = -2; beside <= 2; ++beside) {
        const std::int64_t x = sign * (std::int64_t{1} << k) + beside;
        if (x >= least(width) && x <= most(width)) visit(x);
      }
    }
  }
}

}  // namespace hitpipe::hls::plain
