// binary32 against the host's floating-point unit: every pair of corner patterns, then random pairs with many
// corners. If the host's result is a NaN, ours must be the canonical one.
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "tests/hls/num/float_corners.hpp"
#include "tests/hls/num/float_operators.hpp"

namespace hitpipe::hls::fp_binary32_test {
namespace {

static_assert(std::numeric_limits<float>::is_iec559 && sizeof(float) == 4);

std::uint64_t pattern(float x) {
  return std::isnan(x) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(x);
}

struct Operator {
  const char* name;
  exact::FloatOperator ours;
  std::uint64_t (*host)(float a, float b);
};

// clang-format off
constexpr Operator operators[] = {
    {"a - b", exact::subtract_bits<8, 23>, [](float a, float b) { return pattern(a - b); }},
    {"a * b", exact::multiply_bits<8, 23>, [](float a, float b) { return pattern(a * b); }},
    {"compare(a, b)", exact::compare_bits<8, 23>,
     [](float a, float b) { return std::uint64_t{a < b ? 1U : a > b ? 2U : 0U}; }},
};
// clang-format on
constexpr std::size_t operator_count = std::size(operators);

class Check {
 public:
  void pair(std::uint32_t a, std::uint32_t b) {
    for (const Operator& op : operators) {
      ++checked_;
      const std::uint64_t got = op.ours(a, b);
      const std::uint64_t expected = op.host(std::bit_cast<float>(a), std::bit_cast<float>(b));
      if (got == expected || ++failed_ > 5) continue;
      ADD_FAILURE() << op.name << std::hex << ", a 0x" << a << ", b 0x" << b << ", gives 0x" << got
                    << ", on the host 0x" << expected;
    }
  }

  void finish(std::size_t pairs) const {
    EXPECT_EQ(failed_, 0U);
    EXPECT_EQ(checked_, pairs * operator_count);
    std::cout << checked_ << " results checked\n";
  }

 private:
  std::size_t checked_ = 0;
  std::size_t failed_ = 0;
};

TEST(Binary32, EveryPairOfCornersIsTheHosts) {
  const std::vector<std::uint32_t> corners = exact::corner_floats();
  ASSERT_EQ(corners.size(), 176U);
  Check check;
  for (const std::uint32_t a : corners) {
    for (const std::uint32_t b : corners) check.pair(a, b);
  }
  check.finish(176 * 176);
}

TEST(Binary32, RandomPairsAreTheHosts) {
  constexpr std::uint64_t seed = 81;
  constexpr std::size_t pairs = 2'000'000;
  std::cout << "seed " << seed << '\n';
  exact::FloatPairs random(seed);
  Check check;
  for (std::size_t i = 0; i < pairs; ++i) {
    const exact::FloatPair p = random.next();
    check.pair(p.a, p.b);
  }
  check.finish(pairs);
}

/// Checks that random pairs meet hard cases often; otherwise they would test little.
TEST(Binary32, RandomPairsMeetEveryKindOfResult) {
  constexpr int pairs = 100'000;
  exact::FloatPairs random(82);
  int subnormal_products = 0;
  int overflows = 0;
  int nans = 0;
  int cancellations = 0;
  for (int i = 0; i < pairs; ++i) {
    const exact::FloatPair p = random.next();
    const auto a = std::bit_cast<float>(p.a);
    const auto b = std::bit_cast<float>(p.b);
    subnormal_products += std::fpclassify(a * b) == FP_SUBNORMAL ? 1 : 0;
    overflows += std::isinf(a * b) && !std::isinf(a) && !std::isinf(b) ? 1 : 0;
    nans += std::isnan(a - b) ? 1 : 0;
    cancellations += std::abs(a - b) < std::abs(a) / 4 ? 1 : 0;
  }
  EXPECT_GT(subnormal_products, pairs / 100);
  EXPECT_GT(overflows, pairs / 100);
  EXPECT_GT(nans, pairs / 100);
  EXPECT_GT(cancellations, pairs / 100);
}

}  // namespace
}  // namespace hitpipe::hls::fp_binary32_test
