// The three float operators on patterns, and a check that those of two makes agree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <iostream>
#include <random>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/fp_logic.hpp"
#include "tests/hls/num/float_corners.hpp"

namespace hitpipe::hls::exact {

using FloatOperator = std::function<std::uint64_t(std::uint64_t a, std::uint64_t b)>;

struct FloatOperators {
  FloatOperator subtract, multiply, compare;
};

/// Those of a domain; bits(pattern) is its word of 1 + E + M bits, pattern(word) the way back.
template <class D, class Format, class Bits, class Pattern>
FloatOperators float_operators(Format format, Bits bits, Pattern pattern) {
  return {[=](std::uint64_t a, std::uint64_t b) {
            return pattern(fp_logic::subtract<D>(format, bits(a), bits(b)));
          },
          [=](std::uint64_t a, std::uint64_t b) {
            return pattern(fp_logic::multiply<D>(format, bits(a), bits(b)));
          },
          [=](std::uint64_t a, std::uint64_t b) {
            return pattern(fp_logic::compare<D>(format, bits(a), bits(b)));
          }};
}

template <int E, int M>
FloatOperators native_operators() {
  return float_operators<Native>(
      FpFormat<E, M>(), [](std::uint64_t a) { return ap_uint<1 + E + M>(a); },
      [](const auto& word) { return word.to_uint64(); });
}

/// Runs both makes on pairs, counts results and prints the first few that differ. Each run ends with an
/// assertion.
class FloatCheck {
 public:
  FloatCheck(int exponent_bits, int fraction_bits, FloatOperators got, FloatOperators expected)
      : exponent_bits_(exponent_bits),
        fraction_bits_(fraction_bits),
        got_(std::move(got)),
        expected_(std::move(expected)) {}

  void every_pair() {
    for (std::uint64_t a = 0; a < patterns(); ++a)
      for (std::uint64_t b = 0; b < patterns(); ++b) pair(a, b);
    finish(patterns() * patterns());
  }
  void every_pair_of_corners() {
    const std::vector<std::uint32_t> corners = corner_floats();
    for (const std::uint32_t a : corners)
      for (const std::uint32_t b : corners) pair(a, b);
    finish(corner_float_count * corner_float_count);
  }
  /// Random patterns; in half of the pairs the exponents are near.
  void random_pairs(std::uint64_t seed) {
    constexpr std::size_t pairs = 20'000;
    std::cout << "seed " << seed << '\n';
    std::mt19937_64 random(seed);
    for (std::size_t i = 0; i < pairs; ++i) {
      const std::uint64_t a = random() % patterns();
      const std::uint64_t any = random() % patterns();
      const std::uint64_t low = (std::uint64_t{1} << (fraction_bits_ + static_cast<int>(random() % 3))) - 1;
      pair(a, i % 2 == 0 ? any : a ^ (any & low));
    }
    finish(pairs);
  }
  /// Pairs of binary32 with many corners.
  void random_floats(std::uint64_t seed, std::size_t pairs) {
    std::cout << "seed " << seed << '\n';
    FloatPairs random(seed);
    for (std::size_t i = 0; i < pairs; ++i) {
      const FloatPair p = random.next();
      pair(p.a, p.b);
    }
    finish(pairs);
  }

 private:
  [[nodiscard]] std::uint64_t patterns() const {
    return std::uint64_t{1} << (1 + exponent_bits_ + fraction_bits_);
  }
  void pair(std::uint64_t a, std::uint64_t b) {
    one("a - b", a, b, got_.subtract(a, b), expected_.subtract(a, b));
    one("a * b", a, b, got_.multiply(a, b), expected_.multiply(a, b));
    one("compare(a, b)", a, b, got_.compare(a, b), expected_.compare(a, b));
  }
  void one(const char* operation, std::uint64_t a, std::uint64_t b, std::uint64_t got,
           std::uint64_t expected) {
    ++checked_;
    if (got == expected || ++failed_ > 5) return;
    ADD_FAILURE() << "E = " << exponent_bits_ << ", M = " << fraction_bits_ << std::hex << ": " << operation
                  << ", a 0x" << a << ", b 0x" << b << ", gives 0x" << got << ", expected 0x" << expected;
  }
  void finish(std::size_t pairs) const {
    EXPECT_EQ(failed_, 0U);
    EXPECT_EQ(checked_, 3 * pairs);
    std::cout << checked_ << " results checked of E = " << exponent_bits_ << ", M = " << fraction_bits_
              << '\n';
  }

  int exponent_bits_, fraction_bits_;
  FloatOperators got_, expected_;
  std::size_t checked_ = 0;
  std::size_t failed_ = 0;
};

}  // namespace hitpipe::hls::exact
