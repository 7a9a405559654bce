// binary32 patterns at which float operators break: every sign, exponent and significand of the tables below.
// Then random patterns follow. Many of these are corners, near each other, or far apart in only one field.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <vector>

namespace hitpipe::hls::exact {

struct FloatField {
  std::uint32_t value;
  const char* what;
};

inline constexpr std::array<FloatField, 22> corner_exponents{{
    {0, "zero and subnormal numbers"},
    {1, "the smallest normal numbers"},
    {2, "twice those: a difference may be subnormal"},
    {23, "just short of ulps that are normal"},
    {24, "ulps are the smallest normal numbers"},
    {63, "2^-64: products are subnormal, near the smallest normal"},
    {64, "2^-63: products about the smallest normal"},
    {102, "2^-25: half an ulp below one, or nothing"},
    {103, "2^-24: half an ulp of one"},
    {104, "2^-23: an ulp of one"},
    {125, "2^-2"},
    {126, "2^-1"},
    {127, "one"},
    {128, "2^1"},
    {129, "2^2"},
    {150, "2^23: the ulp is one"},
    {151, "2^24: odd integers end"},
    {152, "2^25: one is less than half an ulp"},
    {190, "2^63: products are about the largest number"},
    {191, "2^64: products overflow"},
    {254, "the largest normal numbers"},
    {255, "infinity and NaN"},
}};

inline constexpr std::array<FloatField, 4> corner_significands{{
    {0, "a power of two, zero or infinity"},
    {1, "one ulp more"},
    {0x7fffff, "all ones"},
    {0x7ffffe, "all ones but the last"},
}};

inline constexpr std::size_t corner_float_count = 2 * corner_exponents.size() * corner_significands.size();

inline std::vector<std::uint32_t> corner_floats() {
  std::vector<std::uint32_t> all;
  for (const std::uint32_t sign : {0U, 1U}) {
    for (const FloatField& exponent : corner_exponents) {
      for (const FloatField& significand : corner_significands) {
        all.push_back(sign << 31 | exponent.value << 23 | significand.value);
      }
    }
  }
  return all;
}

struct FloatPair {
  std::uint32_t a;
  std::uint32_t b;
};

/// Endless pairs from a seeded engine.
class FloatPairs {
 public:
  explicit FloatPairs(std::uint64_t seed) : random_(seed), corners_(corner_floats()) {}

  FloatPair next() {
    const std::uint32_t choice = bits();
    const std::uint32_t a = one(choice % 8);
    const std::uint32_t x = bits();
    switch (choice >> 3 & 7) {
      case 0:  // few ulps away, of either sign
        return {a, (a + x % 8 - 3) ^ (x & sign)};
      case 1:  // exponents up to 63 apart
        return {a, (a ^ (x & (sign | significand))) + (x >> 26 << 23)};
      case 2:  // the product's exponent is near either end
        return {a, (((x & 1) != 0 ? underflow : overflow) - (a & exponent) + (x >> 27 << 23)) ^
                       (x & (sign | significand))};
      default:
        return {a, one(x % 8)};
    }
  }

 private:
  static constexpr std::uint32_t sign = 0x80000000;
  static constexpr std::uint32_t exponent = 0x7f800000;
  static constexpr std::uint32_t significand = 0x007fffff;
  /// In case 2, the least sum of the two operands' exponent fields, in place.
  static constexpr std::uint32_t underflow = 100U << 23;
  static constexpr std::uint32_t overflow = 370U << 23;

  std::uint32_t bits() { return static_cast<std::uint32_t>(random_()); }

  std::uint32_t one(std::uint32_t kind) {
    const std::uint32_t x = bits();
    const std::uint32_t corner = corners_[x % corners_.size()];
    switch (kind) {
      case 0:
        return corner;
      case 1:  // a corner's exponent
        return (corner & exponent) | (x & ~exponent);
      case 2:  // a corner's significand
        return (corner & significand) | (x & ~significand);
      case 3:  // often a subnormal number
        return (x & sign) | (x & ~sign) >> (x & 31);
      default:
        return x;
    }
  }

  std::mt19937_64 random_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace hitpipe::hls::exact
