// The grid of rays that is finer than the grid of boxes (grid.hpp) by g bits: [-1, 1] is mapped to
// [-G 2^g, G 2^g]. All rounding is exact.
#pragma once

#include <cmath>
#include <cstdint>

#include "sw_ref/quantise/grid.hpp"

namespace hitpipe::ref {

/// floor(G 2^g x + 1/2), exact for |x| <= 2, n in 4..32 and g in 0..3.
[[nodiscard]] inline std::int64_t fine_nearest(float x, int coord_bits, int finer) {
  if (coord_bits <= exact_in_double) {
    return static_cast<std::int64_t>(grid_nearest(x, static_cast<double>(grid_scale(coord_bits) << finer)));
  }
  // (2 G 2^g m + 2^s) / 2^(s+1) with |x| = m 2^-s, m < 2^24, 22 <= s <= 149; 2 G 2^g m < 2^58.
  const Binary32 parts = decode(x);
  const int s = -parts.exponent;
  if (s > 60) return 0;  // |G 2^g x| < 2^57 * 2^-61 < 1/2
  const std::int64_t magnitude =
      (grid_scale(coord_bits) << (finer + 1)) * static_cast<std::int64_t>(parts.mantissa);
  return ((parts.negative ? -magnitude : magnitude) + (std::int64_t{1} << s)) >> (s + 1);
}

/// floor(G x - 2^-(g+1)), exact for the same: a plane moved down by half a unit of the finer grid and rounded
/// down to the coarser.
[[nodiscard]] inline std::int64_t fine_lower(float x, int coord_bits, int finer) {
  const int below = finer + 1;
  if (coord_bits <= exact_in_double) {
    const double fine = static_cast<double>(grid_scale(coord_bits) << below) * static_cast<double>(x);
    return (static_cast<std::int64_t>(std::floor(fine)) - 1) >> below;
  }
  const Binary32 parts = decode(x);
  const int s = -parts.exponent;
  if (s > 58) return -1;  // 2^(g+1) |G x| < 2^58 * 2^-59 < 1
  const std::int64_t magnitude =
      (grid_scale(coord_bits) << below) * static_cast<std::int64_t>(parts.mantissa);
  return ((parts.negative ? -magnitude : magnitude) - (std::int64_t{1} << s)) >> (s + below);
}

}  // namespace hitpipe::ref
