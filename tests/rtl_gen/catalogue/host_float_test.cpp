// The host's floating-point unit gives the patterns of the bit-level float operators. Every pair of an 8-bit
// format goes through the same code, with numbers of the host in double precision that are rounded to 8 bits.
// bench/fp_bench.cpp compares 10^8 pairs of binary32.
#include "rtl_gen/catalogue/host_float.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "hls/pipelines/fp_plucker.hpp"
#include "hls/pipelines/fp_plucker_direct.hpp"
#include "hls/pipelines/fp_slabs.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/catalogue/native.hpp"
#include "tests/hls/num/float_corners.hpp"

namespace hitpipe::rtl {

using Float8 = hls::FpFormat<4, 3>;

/// Differences and products of 8-bit floats are exact in double precision. Rounding happens in pattern().
template <>
struct HostNumbers<Float8> {
  using Number = double;
  static constexpr int bias = 7;
  static constexpr int fraction = 3;
  static constexpr int least_exponent = 1 - bias;

  static double number(std::uint32_t pattern) {
    const int field = static_cast<int>(pattern >> fraction & 15);
    const auto rest = static_cast<double>(pattern & 7);
    double magnitude = field == 0 ? std::ldexp(rest, least_exponent - fraction)
                                  : std::ldexp(rest + 8, field - bias - fraction);
    if (field == 15) magnitude = rest == 0 ? HUGE_VAL : std::nan("");
    return std::copysign(magnitude, (pattern & 0x80) != 0 ? -1.0 : 1.0);
  }
  static std::uint32_t pattern(double number) {
    const std::uint32_t sign = std::signbit(number) ? 0x80 : 0;
    const double magnitude = std::abs(number);
    if (magnitude == 0) return sign;
    if (magnitude >= 248) return sign | 0x78;  // half an ulp beyond the largest number, 240
    const int exponent = std::max(std::ilogb(magnitude), least_exponent);
    // Steps of this exponent; a carry moves on to the next exponent by itself.
    const double steps = std::nearbyint(std::ldexp(magnitude, fraction - exponent));
    return sign | static_cast<std::uint32_t>(steps + 8 * (exponent - least_exponent));
  }
};

namespace {

template <class D, class F>
hls::Fp<D, F> fp(std::uint32_t pattern) {
  return {{pattern}, F()};
}

template <class D, class F>
std::vector<std::uint64_t> results(std::uint32_t a, std::uint32_t b) {
  const auto x = fp<D, F>(a);
  const auto y = fp<D, F>(b);
  const hls::Order<typename D::bit> order = fp_compare(x, y);
  return {fp_sub(x, y).bits.to_uint64(), fp_mul(x, y).bits.to_uint64(), order.less.to_uint64(),
          order.greater.to_uint64(), fp_less(x, y).to_uint64()};
}

template <class F>
void expect_same(std::uint32_t a, std::uint32_t b) {
  const auto host = results<HostFloat, F>(a, b);
  const auto bits = results<hls::Native, F>(a, b);
  ASSERT_EQ(host, bits) << std::hex << "a 0x" << a << ", b 0x" << b;
}

TEST(HostFloat, EveryPairOfAnEightBitFormatIsTheBitLevelOne) {
  for (std::uint32_t a = 0; a < 256; ++a)
    for (std::uint32_t b = 0; b < 256; ++b) ASSERT_NO_FATAL_FAILURE(expect_same<Float8>(a, b));
}

TEST(HostFloat, EveryPairOfCornersIsTheBitLevelOne) {
  const std::vector<std::uint32_t> corners = hls::exact::corner_floats();
  for (const std::uint32_t a : corners)
    for (const std::uint32_t b : corners) ASSERT_NO_FATAL_FAILURE(expect_same<hls::Fp32>(a, b));
}

TEST(HostFloat, RandomPairsAreTheBitLevelOnes) {
  hls::exact::FloatPairs random(91);
  for (int i = 0; i < 1'000'000; ++i) {
    const hls::exact::FloatPair pair = random.next();
    ASSERT_NO_FATAL_FAILURE(expect_same<hls::Fp32>(pair.a, pair.b)) << "pair " << i;
  }
}

TEST(HostFloat, EveryNaNOfTheHostIsTheOneOfTheHardware) {
  for (const std::uint32_t nan : {0x7fc00000U, 0xffc00000U, 0x7f800001U, 0xffffffffU}) {
    EXPECT_EQ(fp_sub(fp<HostFloat, hls::Fp32>(nan), fp<HostFloat, hls::Fp32>(0)).bits, 0x7fc00000U);
    EXPECT_EQ(fp_mul(fp<HostFloat, hls::Fp32>(0), fp<HostFloat, hls::Fp32>(nan)).bits, 0x7fc00000U);
  }
  // The processor's own NaN is negative.
  EXPECT_EQ(fp_mul(fp<HostFloat, hls::Fp32>(0x7f800000), fp<HostFloat, hls::Fp32>(0)).bits, 0x7fc00000U);
}

/// Random patterns, corners among them. Numbers that are near each other let a quarter or so of the rays hit.
template <class Pipeline, class F, class Draw>
void expect_same_hits(int tests, Draw&& draw) {
  int hits = 0;
  for (int i = 0; i < tests; ++i) {
    std::vector<std::int64_t> operands;
    typename Pipeline::template Operands<hls::Native, F> in;
    in.for_each(F(), in, [&](const hls::Operand& port, const auto&) {
      operands.push_back(static_cast<std::int64_t>(draw()) & ((std::int64_t{1} << port.width) - 1));
    });
    std::int64_t on_bits = -1;
    std::int64_t on_host = -1;
    detail::run<Pipeline, hls::Native>(F(), operands.data(), &on_bits);
    detail::run<Pipeline, HostFloat>(F(), operands.data(), &on_host);
    ASSERT_EQ(on_host, on_bits) << Pipeline::name << ", test " << i;
    hits += on_host == 1 ? 1 : 0;
  }
  EXPECT_GT(hits, tests / 500) << Pipeline::name;
  EXPECT_LT(hits, tests / 2) << Pipeline::name;
}

template <class Pipeline>
void expect_same_hits_in_both_formats() {
  std::mt19937_64 random(92);
  expect_same_hits<Pipeline, Float8>(100'000, random);
  hls::exact::FloatPairs pairs(93);
  expect_same_hits<Pipeline, hls::Fp32>(50'000, [&] { return pairs.next().a; });
}

TEST(HostFloat, PipelinesHitAsTheyDoBitByBit) {
  expect_same_hits_in_both_formats<hls::FpSlabs>();
  expect_same_hits_in_both_formats<hls::FpPlucker>();
  expect_same_hits_in_both_formats<hls::FpPluckerDirect>();
}

TEST(HostFloat, DesignsOfFloatsHaveAFunctionOfTheirOwn) {
  for (const Design& design : designs()) {
    const auto evaluate = design.evaluate_on_float_unit(design.default_format);
    EXPECT_EQ(evaluate.has_value(), design.default_format.is<hls::Binary32>()) << design.name;
    const bool same = design.float_unit_run_at(design.default_format) == design.run_at(design.default_format);
    EXPECT_FALSE(same) << design.name;
  }
}

}  // namespace
}  // namespace hitpipe::rtl
