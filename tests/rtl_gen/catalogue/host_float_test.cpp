// The host's floating-point unit gives the patterns of the bit-level float operators.
// bench/fp_bench.cpp compares 10^8 pairs of binary32.
#include "rtl_gen/catalogue/host_float.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/catalogue/native.hpp"
#include "tests/hls/num/float_corners.hpp"

namespace hitpipe::rtl {

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

/// Random patterns, corners among them. Numbers that are near each other let some of the rays hit.
TEST(HostFloat, DesignsHitAsTheyDoBitByBit) {
  constexpr int tests = 50'000;
  for (const Design& design : designs()) {
    const Format format = design.default_format;
    const auto on_host = design.evaluate_on_float_unit(format);
    EXPECT_EQ(on_host.has_value(), format.is<hls::Binary32>()) << design.name;
    EXPECT_NE(design.float_unit_run_at(format), design.run_at(format)) << design.name;
    if (!on_host) continue;
    const Evaluate on_bits = design.evaluate(format);
    const std::size_t ports = design.ports(format).size();
    hls::exact::FloatPairs pairs(93);
    int hits = 0;
    for (int i = 0; i < tests; ++i) {
      std::vector<std::int64_t> operands;
      while (operands.size() < ports) operands.push_back(pairs.next().a);
      ASSERT_EQ((*on_host)(operands.data()), on_bits(operands.data())) << design.name << ", test " << i;
      hits += on_bits(operands.data()) ? 1 : 0;
    }
    EXPECT_GT(hits, tests / 500) << design.name;
    EXPECT_LT(hits, tests / 2) << design.name;
  }
}

}  // namespace
}  // namespace hitpipe::rtl
