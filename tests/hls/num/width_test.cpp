// Widths: arithmetic on Widths gives Widths, on ints and mixtures it gives ints; loops and choices over both.
#include "hls/num/width.hpp"

#include <cstdint>
#include <type_traits>

#include <gtest/gtest.h>

#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"

namespace hitpipe::hls::width_test {
namespace {

template <class T, class U>
constexpr bool same(T, U) {
  return std::is_same_v<T, U>;
}

static_assert(same(24_w, Width<24>()));
static_assert(same(2_w * 20_w - 1_w, Width<39>()));
static_assert(same(7_w / 2_w, Width<3>()));
static_assert(same(max(3_w, 5_w), Width<5>()) && same(min(3_w, 5_w), Width<3>()));
static_assert(same(power_of_two(5_w), Width<32>()) && same(count_bits(33_w), Width<6>()));
static_assert(count_bits(1) == 0 && count_bits(2) == 1 && count_bits(3) == 2 && count_bits(4) == 2);
static_assert(same(3_w < 5_w, Truth<true>()) && same(5_w < 5_w, Truth<false>()));
static_assert(same(20 - 1_w, 19) && 20 - 1_w == 19 && same(3_w < 5, true));
static_assert(same(min(3_w, 5), 3) && max(3_w, 5) == 5);

static_assert(low_mask(0) == 0 && low_mask(1) == 1 && low_mask(63) == ~std::uint64_t{0} >> 1);
static_assert(low_mask(64) == ~std::uint64_t{0});
static_assert(sign_extended(~std::uint64_t{0}, 0) == 0 && sign_extended(1, 1) == -1 &&
              sign_extended(2, 1) == 0);
static_assert(sign_extended(0x7F, 8) == 127 && sign_extended(0xF80, 8) == -128);
static_assert(sign_extended(std::uint64_t{1} << 63, 64) == INT64_MIN);

/// N - 8: compiles only for N of at least 8.
template <int N>
constexpr Width<N - 8> less_eight(Width<N>) {
  static_assert(N >= 8);
  return {};
}

TEST(Levels, OfWidthsMayChangeTheType) {
  const auto sum = for_each_level(4_w, 0_w, [](auto so_far, auto level) { return so_far + level + 1_w; });
  static_assert(std::is_same_v<decltype(sum), const Width<10>>);
  EXPECT_EQ(for_each_level(4, 0, [](int so_far, int level) { return so_far + level + 1; }), 10);
  EXPECT_EQ(for_each_level(0, 7, [](int, int) { return 0; }), 7);
}

TEST(ChangeIf, CompilesNoBranchThatIsNotTaken) {
  const auto changed = change_if(7_w < 8_w, 8_w, [](auto x) { return less_eight(x); });
  static_assert(std::is_same_v<decltype(changed), const Width<0>>);
  const auto kept = change_if(8_w < 8_w, 5_w, [](auto x) { return less_eight(x); });
  static_assert(std::is_same_v<decltype(kept), const Width<5>>);
  EXPECT_EQ(change_if(true, 5, [](int x) { return x + 1; }), 6);
  EXPECT_EQ(change_if(false, 5, [](int x) { return x + 1; }), 5);
}

}  // namespace
}  // namespace hitpipe::hls::width_test
