// A seeded engine without the distributions of the standard library: one program draws the same cases from a
// seed wherever it runs.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace hitpipe::ref::adversary {

class Random {
 public:
  explicit Random(std::uint64_t seed) : bits_(seed) {}

  std::uint64_t bits() { return bits_(); }
  std::uint64_t below(std::uint64_t count) { return bits_() % count; }
  int between(int low, int high) {
    return low +
           static_cast<int>(below(static_cast<std::uint64_t>(high) - static_cast<std::uint64_t>(low) + 1));
  }
  bool coin() { return below(2) == 0; }
  int axis() { return between(0, 2); }
  float sign() { return coin() ? 1.0F : -1.0F; }
  float signed_zero() { return coin() ? 0.0F : -0.0F; }
  /// In [-1, 1], of full precision.
  float signed_unit() { return static_cast<float>(static_cast<double>(bits_() >> 11) * 0x1p-52 - 1.0); }
  /// A multiple of 2^-6 in [-63/64, 63/64].
  float coarse() { return static_cast<float>(between(-63, 63)) * 0x1p-6F; }
  /// +-m 2^e, 1 <= m < 2; exponents below -126 give subnormals.
  float of_exponent(int low, int high) {
    const float mantissa = 1.0F + static_cast<float>(below(1U << 23)) * 0x1p-23F;
    return sign() * std::ldexp(mantissa, between(low, high));
  }

 private:
  std::mt19937_64 bits_;
};

}  // namespace hitpipe::ref::adversary
