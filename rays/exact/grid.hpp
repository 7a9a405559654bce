// The integer grid of n-bit coordinates (section 6.2.1), and its limits G and M. [-1, 1] is mapped to [-G,
// G], so that the difference of two coordinates still fits n bits. The grid of ray origins may be finer by g
// bits: there [-1, 1] is mapped to [-G 2^g, G 2^g]. All rounding is exact: it uses integers
// made of the binary32's mantissa and exponent.
#pragma once

#include <cmath>
#include <cstdint>

#include "rays/exact/binary32.hpp"

#ifdef __FAST_MATH__
#error "rounding to a grid needs IEEE arithmetic: build without -ffast-math"
#endif

namespace hitpipe::ref {

/// G = 2^(n-2) - 1: the integer coordinate of 1. n is in 6..32.
[[nodiscard]] constexpr std::int64_t grid_scale(int coord_bits) {
  return (std::int64_t{1} << (coord_bits - 2)) - 1;
}

/// 2^(n-2) = G + 1: the largest magnitude of an outward rounded box coordinate.
[[nodiscard]] constexpr std::int64_t grid_limit(int coord_bits) {
  return std::int64_t{1} << (coord_bits - 2);
}

/// M = 2^(n-1) - 1 = G + (G + 1): the largest n-bit word. No difference between a box coordinate and a ray
/// origin exceeds it, and the set-ups scale directions and inverse directions to it.
[[nodiscard]] constexpr std::int64_t direction_limit(int coord_bits) {
  return (std::int64_t{1} << (coord_bits - 1)) - 1;
}

/// Up to this n, G x has at most 29 + 24 bits and is exact in a double.
inline constexpr int exact_in_double = 31;

/// floor(s * x + 1/2) with s = G or -G, exact for |x| <= 2 and n <= exact_in_double. There is no branch, so
/// loops over it vectorise. Let s x = k + f, with k a nearest integer: the result is k, or k + 1 if f = 1/2.
/// A double near 1.5 * 2^52 has no bits below 1. So the sum rounds s x to k, and both differences are exact.
[[nodiscard]] inline double grid_nearest(float x, double scale) {
  constexpr double without_fraction = 0x1.8p52;
  const double scaled = scale * static_cast<double>(x);
  const double nearest = (scaled + without_fraction) - without_fraction;
  return nearest + (scaled - nearest == 0.5 ? 1.0 : 0.0);
}

/// floor(G 2^g x + 1/2), exact for |x| <= 2, n in 4..32 and g in 0..3.
[[nodiscard]] inline std::int64_t fine_nearest(float x, int coord_bits, int finer = 0) {
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
[[nodiscard]] inline std::int64_t fine_lower(float x, int coord_bits, int finer = 0) {
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
