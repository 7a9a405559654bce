// binary32 against the host's floating-point unit: every pair of corner patterns, then random pairs with many
// corners. If the host's result is a NaN, ours must be the canonical one.
#include <bit>
#include <cmath>
#include <limits>

#include "tests/hls/num/float_check.hpp"

namespace hitpipe::hls::fp_binary32_test {
namespace {

static_assert(std::numeric_limits<float>::is_iec559 && sizeof(float) == 4);

std::uint64_t pattern(float x) {
  return std::isnan(x) ? 0x7fc00000U : std::bit_cast<std::uint32_t>(x);
}

exact::FloatCheck check() {
  const auto on_host = [](auto operation) {
    return [operation](std::uint64_t a, std::uint64_t b) {
      return operation(std::bit_cast<float>(static_cast<std::uint32_t>(a)),
                       std::bit_cast<float>(static_cast<std::uint32_t>(b)));
    };
  };
  return {8,
          23,
          exact::native_operators<8, 23>(),
          {on_host([](float a, float b) { return pattern(a - b); }),
           on_host([](float a, float b) { return pattern(a * b); }), on_host([](float a, float b) {
             return std::uint64_t{a < b ? 1U : a > b ? 2U : 0U};
           })}};
}

TEST(Binary32, EveryPairOfCornersIsTheHosts) {
  check().every_pair_of_corners();
}

TEST(Binary32, RandomPairsAreTheHosts) {
  check().random_floats(81, 2'000'000);
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
