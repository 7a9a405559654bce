// The saturating shift against plain integers: every number and exponent of narrow widths, corners and random
// numbers of wide formats, with widths known when the code is compiled and with widths known at run time.
#include "hls/num/saturating_shift.hpp"

#include <cstdint>
#include <iostream>
#include <random>
#include <utility>

#include <gtest/gtest.h>

#include "hls/num/domain.hpp"
#include "hls/num/sized.hpp"
#include "tests/hls/num/plain_shift.hpp"

namespace hitpipe::hls::saturating_shift_test {
namespace {

constexpr std::uint64_t seed = 611;

template <int W>
std::int64_t native(std::int64_t x, int e) {
  const ap_int<W> shifted =
      saturating_shift<Native>(ap_int<W>(x), ap_uint<count_bits(W)>(static_cast<unsigned>(e)));
  return shifted.to_int64();
}
std::int64_t sized(std::int64_t x, int e, int width) {
  const auto shifted = saturating_shift<Sized>(Sized::sint(static_cast<std::uint64_t>(x), width),
                                               Sized::uint(static_cast<std::uint64_t>(e), count_bits(width)));
  EXPECT_EQ(shifted.width(), width);
  return shifted.to_int64();
}

template <int W>
void expect_plain(std::int64_t x, int e) {
  const std::int64_t expected = plain::saturating_shift(x, e, W);
  ASSERT_EQ(native<W>(x, e), expected) << x << " << " << e << " in " << W << " bits";
  ASSERT_EQ(sized(x, e, W), expected) << x << " << " << e << " in " << W << " bits";
}

/// Calls each.template operator()<W>() for First .. Last.
template <int First, int Last, class Each>
void for_each_width(const Each& each) {
  [&]<int... I>(std::integer_sequence<int, I...>) {
    (each.template operator()<First + I>(), ...);
  }
  (std::make_integer_sequence<int, Last - First + 1>());
}

/// 5 and 9 bits among them: there the largest shift moves the whole magnitude out.
TEST(SaturatingShift, OfEveryNumberByEveryExponentIsPlain) {
  int checked = 0;
  for_each_width<2, 10>([&]<int W>() {
    for (std::int64_t x = plain::least(W); x <= plain::most(W); ++x) {
      for (int e = 0; e < W; ++e, ++checked) ASSERT_NO_FATAL_FAILURE(expect_plain<W>(x, e));
    }
  });
  EXPECT_EQ(checked, 9 << 11) << "sum over W = 2 .. 10 of W 2^W";
}

TEST(SaturatingShift, OfWideNumbersIsPlain) {
  std::cout << "seed " << seed << '\n';
  std::mt19937_64 random(seed);
  int checked = 0;
  int saturated = 0;
  for_each_width<11, 35>([&]<int W>() {
    const auto one = [&](std::int64_t x, int e) {
      ASSERT_NO_FATAL_FAILURE(expect_plain<W>(x, e));
      const std::int64_t shifted = plain::saturating_shift(x, e, W);
      saturated += shifted == plain::most(W) || shifted == plain::least(W) ? 1 : 0;
      ++checked;
    };
    plain::for_each_corner(W, [&](std::int64_t x) {
      for (int e = 0; e < W; ++e) one(x, e);
    });
    for (int i = 0; i < 2'000; ++i) {
      // Short numbers too, which a long shift still holds.
      const auto x = static_cast<std::int64_t>(random()) >> (64 - W + static_cast<int>(random() % W));
      one(x, static_cast<int>(random() % W));
    }
  });
  EXPECT_GT(checked, 25 * 2'000);
  EXPECT_GT(saturated, checked / 4);
  EXPECT_LT(saturated, checked * 3 / 4);
}

}  // namespace
}  // namespace hitpipe::hls::saturating_shift_test
