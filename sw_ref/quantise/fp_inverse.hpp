// Bounds of a scaled inverse direction component in a float format, and the scale. All is exact: it is
// computed with integers made of the binary32's mantissas and exponents.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "hls/box/fp_format.hpp"
#include "rays/exact/binary32.hpp"

namespace hitpipe::ref {

/// A positive binary32 as 2^exponent m / 2^24 with m in 2^23 + 1 .. 2^24.
struct UpToPower {
  std::uint64_t mantissa;
  int exponent;
};

inline UpToPower up_to_power(float x) {
  const Binary32 parts = decode(x);
  const int spare = std::countl_zero(parts.mantissa) - 8;
  const UpToPower normal{std::uint64_t{parts.mantissa} << spare, parts.exponent - spare + 24};
  const bool is_power = normal.mantissa == 1U << 23;
  return is_power ? UpToPower{1U << 24, normal.exponent - 1} : normal;
}

/// The pattern of units 2^(exponent - M) with units in 2^M .. 2^(M+1).
inline std::int64_t fp_pattern_of(std::uint64_t units, int exponent, const hls::FpBits& bits) {
  // The implicit one adds 1 to the exponent field; so does a carry.
  return (std::int64_t{exponent + bits.bias() - 1} << bits.fraction) + static_cast<std::int64_t>(units);
}

/// Patterns without sign, with size at most 2^scale: low <= 2^scale / size and (1 + 2^-M) 2^scale / size <=
/// high. Both are infinite for 0. Neither grows with the size.
struct FpInverse {
  std::int64_t low, high;
};

inline FpInverse fp_inverse(int scale, float size, const hls::FpBits& bits) {
  if (size == 0.0F) return {bits.infinity(), bits.infinity()};
  // 2^scale / size = 2^exponent 2^24 / m, and 2^24 / m is in [1, 2).
  const UpToPower parts = up_to_power(size);
  const int exponent = scale - parts.exponent;
  if (exponent > bits.bias()) return {bits.infinity() - 1, bits.infinity()};
  const std::uint64_t one = std::uint64_t{1} << bits.fraction;
  const std::uint64_t high = (((one + 1) << 24) + parts.mantissa - 1) / parts.mantissa;
  const bool carries = high > 2 * one;
  return {fp_pattern_of((one << 24) / parts.mantissa, exponent, bits),
          std::min(bits.infinity(), carries ? fp_pattern_of((high + 1) / 2, exponent + 1, bits)
                                            : fp_pattern_of(high, exponent, bits))};
}

}  // namespace hitpipe::ref
