// The float operators against exact arithmetic rounded once: every pair of small formats, random pairs of
// wide and lopsided formats.
#include <cstddef>
#include <iostream>
#include <random>

#include <gtest/gtest.h>

#include "hls/num/fp.hpp"
#include "hls/num/fp_logic.hpp"
#include "tests/hls/num/exact_float.hpp"
#include "tests/hls/num/float_operators.hpp"

namespace hitpipe::hls::fp_exact_test {
namespace {

using exact::FloatFormat;

/// Compares all operators on a pair, counts results, prints the first few that differ.
template <int E, int M>
class Check {
 public:
  void pair(std::uint64_t a, std::uint64_t b) {
    one("a - b", a, b, exact::subtract_bits<E, M>(a, b), format_.subtract(a, b));
    one("a * b", a, b, exact::multiply_bits<E, M>(a, b), format_.multiply(a, b));
    one("compare(a, b)", a, b, exact::compare_bits<E, M>(a, b), format_.compare(a, b));
  }

  void finish(std::size_t intended) const {
    EXPECT_EQ(failed_, 0U);
    EXPECT_EQ(checked_, intended);
    std::cout << checked_ << " results checked of E = " << E << ", M = " << M << '\n';
  }

 private:
  void one(const char* operation, std::uint64_t a, std::uint64_t b, std::uint64_t got,
           std::uint64_t expected) {
    ++checked_;
    if (got == expected || ++failed_ > 5) return;
    ADD_FAILURE() << "E = " << E << ", M = " << M << std::hex << ": " << operation << ", a 0x" << a
                  << ", b 0x" << b << ", gives 0x" << got << ", exactly 0x" << expected;
  }

  FloatFormat format_{E, M};
  std::size_t checked_ = 0;
  std::size_t failed_ = 0;
};

template <int E, int M>
void check_every_pair() {
  constexpr std::uint64_t patterns = std::uint64_t{1} << (1 + E + M);
  Check<E, M> check;
  for (std::uint64_t a = 0; a < patterns; ++a) {
    for (std::uint64_t b = 0; b < patterns; ++b) check.pair(a, b);
  }
  check.finish(3 * patterns * patterns);
}

TEST(FloatOperators, EveryPairOfAnEightBitFormatIsExactlyRounded) {
  check_every_pair<4, 3>();
}

TEST(FloatOperators, EveryPairOfTinyFormatsIsExactlyRounded) {
  check_every_pair<3, 2>();
  check_every_pair<2, 1>();
  check_every_pair<2, 4>();
  check_every_pair<5, 1>();
  check_every_pair<3, 3>();
}

/// Random patterns; in half of the pairs the exponents are near.
template <int E, int M>
void check_random_pairs(std::uint64_t seed) {
  constexpr int pairs = 20000;
  constexpr std::uint64_t mask = (std::uint64_t{1} << (1 + E + M)) - 1;
  std::mt19937_64 random(seed);
  std::cout << "seed " << seed << '\n';
  Check<E, M> check;
  for (int i = 0; i < pairs; ++i) {
    const std::uint64_t a = random() & mask;
    const std::uint64_t any = random() & mask;
    const std::uint64_t low = (std::uint64_t{1} << (M + random() % 3)) - 1;
    check.pair(a, i % 2 == 0 ? any : a ^ (any & low));
  }
  check.finish(std::size_t{3} * pairs);
}

TEST(FloatOperators, RandomPairsOfWideAndLopsidedFormatsAreExactlyRounded) {
  check_random_pairs<5, 10>(71);
  check_random_pairs<8, 7>(72);
  check_random_pairs<8, 1>(73);
  check_random_pairs<2, 23>(74);
  check_random_pairs<3, 23>(75);
  check_random_pairs<6, 14>(76);
  check_random_pairs<7, 15>(77);
  check_random_pairs<8, 23>(78);
}

/// The reference itself, on literals of the 8-bit format: bias 7, one is 0x38, the largest number 240 0x77.
TEST(ExactFloat, KnowsTheFormatsLandmarks) {
  constexpr FloatFormat f{4, 3};
  EXPECT_EQ(f.units(0x38), 512);  // 1 / 2^-9
  EXPECT_EQ(f.nearest(512, 0), 0x38U);
  EXPECT_EQ(f.nearest(247 * 512, 0), 0x77U);  // under half an ulp beyond the largest
  EXPECT_EQ(f.nearest(248 * 512, 0), 0x78U);  // the tie goes to infinity
  EXPECT_EQ(f.nearest(1, 1), 0U);             // half the smallest: to zero, the even one
  EXPECT_EQ(f.nearest(3, 1), 2U);             // one and a half
  EXPECT_EQ(f.subtract(0x80, 0x00), 0x80U);   // -0 - +0
  EXPECT_EQ(f.subtract(0x38, 0x38), 0x00U);
  EXPECT_EQ(f.subtract(0xb8, 0xb8), 0x00U);
  EXPECT_EQ(f.multiply(0x38, 0x80), 0x80U);
  EXPECT_EQ(f.multiply(0x78, 0x80), 0x7cU);  // infinity times -0
  EXPECT_EQ(f.compare(0x00, 0x80), 0U);
  EXPECT_EQ(f.compare(0xb8, 0x38), 1U);
}

constexpr Fp<Native, Fp32> binary32(std::uint32_t bits) {
  return {ap_uint<32>(bits)};
}

static_assert(fp_sub(binary32(0x40400000), binary32(0x3f800000)).bits == 0x40000000U);  // 3 - 1
static_assert(fp_mul(binary32(0x40400000), binary32(0xc0000000)).bits == 0xc0c00000U);  // 3 * -2
static_assert(fp_mul(binary32(0x7f800000), binary32(0x80000000)).bits == 0x7fc00000U);  // infinity * -0
static_assert(fp_compare(binary32(0x3f800000), binary32(0x40400000)).less == 1U);
static_assert(fp_compare(binary32(0xbf800000), binary32(0xc0400000)).greater == 1U);
static_assert(fp_less(binary32(0x80000000), binary32(0x00000000)) == 0U);
static_assert(sign(binary32(0x80000000)) == 1U);

}  // namespace
}  // namespace hitpipe::hls::fp_exact_test
