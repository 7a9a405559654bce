// The integer grid of n-bit coordinates (section 6.2.1), and its limits G and M. [-1, 1] is mapped to [-G,
// G], so that the difference of two coordinates still fits n bits. All rounding is exact: it uses integers
// made of the binary32's mantissa and exponent.
#pragma once

#include <cstdint>

#include "sw_ref/judge/binary32.hpp"

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

enum class Half : int { down = -1, up = 1 };

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

/// floor(G * x - 1/2) or floor(G * x + 1/2), exact for |x| <= 2 and n in 6..32.
[[nodiscard]] inline std::int64_t grid_floor(float x, int coord_bits, Half half) {
  if (coord_bits <= exact_in_double) {
    const double up = grid_nearest(x, static_cast<double>(grid_scale(coord_bits)));
    return static_cast<std::int64_t>(up) - (half == Half::down ? 1 : 0);
  }
  // G x +- 1/2 = (2 G m +- 2^s) / 2^(s+1) with |x| = m 2^-s, m < 2^24, 22 <= s <= 149; 2 G m < 2^55.
  const Binary32 parts = decode(x);
  const int s = -parts.exponent;
  if (s > 60) {
    return half == Half::down ? -1 : 0;  // |G x| < 2^54 * 2^-61 < 1/2
  }
  const std::int64_t magnitude = 2 * grid_scale(coord_bits) * static_cast<std::int64_t>(parts.mantissa);
  const std::int64_t one_half = static_cast<std::int64_t>(half) * (std::int64_t{1} << s);
  return ((parts.negative ? -magnitude : magnitude) + one_half) >> (s + 1);
}

}  // namespace hitpipe::ref
