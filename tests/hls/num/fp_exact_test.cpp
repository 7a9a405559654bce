// The float operators against exact arithmetic rounded once: every pair of small formats, random pairs of
// wide and lopsided formats.
#include "hls/num/fp.hpp"
#include "tests/hls/num/exact_float.hpp"
#include "tests/hls/num/float_check.hpp"

namespace hitpipe::hls::fp_exact_test {
namespace {

using exact::FloatFormat;

template <int E, int M>
exact::FloatCheck check() {
  constexpr FloatFormat format{E, M};
  return {E,
          M,
          exact::native_operators<E, M>(),
          {[=](std::uint64_t a, std::uint64_t b) { return format.subtract(a, b); },
           [=](std::uint64_t a, std::uint64_t b) { return format.multiply(a, b); },
           [=](std::uint64_t a, std::uint64_t b) { return format.compare(a, b); }}};
}

TEST(FloatOperators, EveryPairOfSmallFormatsIsExactlyRounded) {
  check<4, 3>().every_pair();
  check<3, 2>().every_pair();
  check<2, 1>().every_pair();
  check<2, 4>().every_pair();
  check<5, 1>().every_pair();
  check<3, 3>().every_pair();
}

TEST(FloatOperators, RandomPairsOfWideAndLopsidedFormatsAreExactlyRounded) {
  check<5, 10>().random_pairs(71);
  check<8, 7>().random_pairs(72);
  check<8, 1>().random_pairs(73);
  check<2, 23>().random_pairs(74);
  check<3, 23>().random_pairs(75);
  check<6, 14>().random_pairs(76);
  check<7, 15>().random_pairs(77);
  check<8, 23>().random_pairs(78);
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
