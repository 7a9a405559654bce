// The parts of a finite binary32: |x| = mantissa * 2^exponent, both integers. Every finite binary32 is a
// multiple of 2^-149 and less than 2^128 in magnitude; all exact arithmetic of sw_ref uses this.
#pragma once

#include <bit>
#include <cstdint>

namespace hitpipe::ref {

struct Binary32 {
  std::uint32_t mantissa;  ///< < 2^24
  int exponent;            ///< -149..104; it never falls as |x| grows
  bool negative;           ///< the sign bit, also for zeros
};

/// Splits a finite `x`. The mantissa is below 2^23 only for subnormals and zeros, which have exponent -149.
[[nodiscard]] inline Binary32 decode(float x) {
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t fraction = bits & 0x7FFFFFU;
  const int biased = static_cast<int>((bits >> 23) & 0xFFU);
  const bool negative = (bits >> 31) != 0;
  return biased == 0 ? Binary32{fraction, -149, negative}
                     : Binary32{fraction | 0x800000U, biased - 150, negative};
}

/// The least binary32 that is not below x, for an x that is 0..largest binary32.
[[nodiscard]] inline float rounded_up(double x) {
  const auto nearest = static_cast<float>(x);
  // As x >= 0, this is the next larger one.
  return nearest >= x ? nearest : std::bit_cast<float>(std::bit_cast<std::uint32_t>(nearest) + 1U);
}

}  // namespace hitpipe::ref
