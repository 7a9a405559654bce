// A slow exact reference for the float operators. Every finite number of a format is an integer multiple of
// the smallest subnormal number. A result is an exact integer over a power of two. The nearest pattern is
// found by searching the patterns, whose values ascend. It has no shift, guard or sticky bit, so it shares no
// method with fp_logic.
#pragma once

#include <cstdint>

#include "tests/hls/num/exact.hpp"

namespace hitpipe::hls::exact {

/// E exponent and M fraction bits; a pattern is an unsigned of 1+E+M bits.
struct FloatFormat {
  int exponent_bits;
  int fraction_bits;

  [[nodiscard]] int width() const { return 1 + exponent_bits + fraction_bits; }
  [[nodiscard]] std::uint64_t sign() const { return std::uint64_t{1} << (width() - 1); }
  [[nodiscard]] std::uint64_t infinity() const {
    return ((std::uint64_t{1} << exponent_bits) - 1) << fraction_bits;
  }
  [[nodiscard]] std::uint64_t quiet_nan() const {
    return infinity() | std::uint64_t{1} << (fraction_bits - 1);
  }
  /// The smallest subnormal number is 2 to the minus this.
  [[nodiscard]] int unit_exponent() const { return (1 << (exponent_bits - 1)) - 2 + fraction_bits; }

  [[nodiscard]] std::uint64_t magnitude(std::uint64_t bits) const { return bits & (sign() - 1); }
  [[nodiscard]] bool is_negative(std::uint64_t bits) const { return (bits & sign()) != 0; }
  [[nodiscard]] bool is_nan(std::uint64_t bits) const { return magnitude(bits) > infinity(); }
  [[nodiscard]] bool is_infinite(std::uint64_t bits) const { return magnitude(bits) == infinity(); }
  [[nodiscard]] bool is_zero(std::uint64_t bits) const { return magnitude(bits) == 0; }

  /// Magnitude in units of the smallest subnormal number. Infinity counts as the number after the largest.
  [[nodiscard]] Integer units(std::uint64_t bits) const {
    const std::uint64_t scale = std::uint64_t{1} << fraction_bits;
    const std::uint64_t exponent = magnitude(bits) / scale;
    const Integer fraction = magnitude(bits) % scale;
    return exponent == 0 ? fraction
                         : Integer((fraction + scale) * power_of_two(static_cast<int>(exponent) - 1));
  }
  [[nodiscard]] Integer signed_units(std::uint64_t bits) const {
    return is_negative(bits) ? Integer(-units(bits)) : units(bits);
  }

  /// The pattern nearest to magnitude numerator / 2^shift units, without a sign. Of two, the even one.
  [[nodiscard]] std::uint64_t nearest(const Integer& numerator, int shift) const {
    const Integer one = power_of_two(shift);
    std::uint64_t below = 0;  // units(below) <= the magnitude
    for (std::uint64_t step = infinity(); step != 0;) {
      const bool fits = below + step <= infinity() && units(below + step) * one <= numerator;
      if (fits) {
        below += step;
      } else {
        step /= 2;
      }
    }
    if (below == infinity()) return below;
    const Integer twice = numerator * 2;
    const Integer ends = (units(below) + units(below + 1)) * one;
    if (twice == ends) return below % 2 == 0 ? below : below + 1;
    return twice < ends ? below : below + 1;
  }

  [[nodiscard]] std::uint64_t subtract(std::uint64_t a, std::uint64_t b) const {
    if (is_nan(a) || is_nan(b)) return quiet_nan();
    if (is_infinite(a) && is_infinite(b)) return is_negative(a) == is_negative(b) ? quiet_nan() : a;
    if (is_infinite(a)) return a;
    if (is_infinite(b)) return b ^ sign();
    const Integer difference = signed_units(a) - signed_units(b);
    if (difference == 0) return is_zero(a) && is_negative(a) && !is_negative(b) ? sign() : 0;
    return difference < 0 ? sign() | nearest(-difference, 0) : nearest(difference, 0);
  }

  [[nodiscard]] std::uint64_t multiply(std::uint64_t a, std::uint64_t b) const {
    if (is_nan(a) || is_nan(b)) return quiet_nan();
    const bool infinite = is_infinite(a) || is_infinite(b);
    if (infinite && (is_zero(a) || is_zero(b))) return quiet_nan();
    const std::uint64_t negative = is_negative(a) != is_negative(b) ? sign() : 0;
    if (infinite) return negative | infinity();
    return negative | nearest(units(a) * units(b), unit_exponent());
  }

  [[nodiscard]] std::uint64_t compare(std::uint64_t a, std::uint64_t b) const {
    if (is_nan(a) || is_nan(b)) return 0;
    const Integer difference = signed_units(a) - signed_units(b);
    return difference < 0 ? 1 : difference > 0 ? 2 : 0;
  }
};

}  // namespace hitpipe::hls::exact
