// The free functions of the native domain against exact bit patterns.
#include "hls/num/domain.hpp"

#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::domain_test {
namespace {

using exact::Integer;
using exact::Row;

template <class A>
inline constexpr int inner_hi = A::width - 1 - A::width / 5;
template <class A>
inline constexpr int inner_lo = A::width / 3;

TEST(NativeDomain, SliceCutsTheNamedBits) {
  exact::Run run(61);
  const auto cut = []<class A>(const A& a, const exact::Choice& choice) -> ap_uint<128> {
    switch (choice.variant) {
      case 0:
        return slice(a, Width<inner_hi<A>>(), Width<inner_lo<A>>());
      case 1:
        return sign(a);
      case 2:
        return bit_at(a, 0_w);
      default:
        return slice(a, width_of(a) - 1_w, 0_w);
    }
  };
  run.check_choices(
      {"slice inside", "slice of the top bit", "slice of the low bit", "slice of all"},
      exact::rows_of_choice(cut), [](const exact::Type&, std::mt19937_64&) { return exact::Choice(0, 0, 0); },
      [](const Row& row, const Integer& a, const exact::Choice& choice) {
        const int w = row.a.width;
        const Integer bits = exact::pattern(a, w);
        switch (choice.variant) {
          case 0:
            return exact::pattern(bits >> static_cast<unsigned>(w / 3), w - w / 5 - w / 3);
          case 1:
            return Integer(bits >> static_cast<unsigned>(w - 1));
          case 2:
            return exact::pattern(bits, 1);
          default:
            return bits;
        }
      });
  run.finish(4 * exact::choice_row_count * exact::values_per_row);
}

TEST(NativeDomain, CatResizeAndSelectKeepBits) {
  exact::Run run(62);
  run.check("cat", exact::crossed_rows([](const auto& a, const auto& b) { return cat(a, b); }),
            [](const Row& row, const Integer& a, const Integer& b) {
              const Integer high = exact::pattern(a, row.a.width) << static_cast<unsigned>(row.b.width);
              return Integer(high + exact::pattern(b, row.b.width));
            });
  run.check("resize", exact::crossed_rows([]<class A, class B>(const A& a, const B&) {
              return resize(a, Width<B::width>());
            }),
            [](const Row& row, const Integer& a, const Integer&) {
              return exact::wrapped(a, row.b.width, row.a.is_signed);
            });
  run.check("select", exact::crossed_rows([]<class A, class B>(const A& a, const B& b) {
              const ap_uint<1> less{a < b};
              return select(less, a, A(b));
            }),
            [](const Row& row, const Integer& a, const Integer& b) {
              return a < b ? a : exact::wrapped(b, row.a.width, row.a.is_signed);
            });
  run.finish(3 * exact::crossed_row_count * exact::pairs_per_row);
}

TEST(NativeDomain, LitWrapsAndAsChangesNothing) {
  EXPECT_EQ(Native::lit(0x1ff, 8_w), 0xff);
  EXPECT_EQ(Native::lit(-1, 70_w), ap_uint<70>(-1));
  EXPECT_EQ(as("near", ap_int<9>(-200)), -200);
  EXPECT_EQ(as("near", 'y', ap_int<9>(-200)), -200);
}

/// Stands in for a value of another domain. The native functions must not apply to it.
struct ForeignValue {};

template <class T>
concept sliced = requires(T x) {
  slice(x, 0_w, 0_w);
};
template <class T>
concept named = requires(T x) {
  as("x", x);
};
template <class T>
concept joined = requires(T x) {
  cat(x, x);
};

static_assert(!sliced<ForeignValue> && !named<ForeignValue> && !joined<ForeignValue>);
static_assert(!sliced<int> && !named<int> && !joined<int>);
static_assert(sliced<ap_int<3>> && named<ap_int<3>> && joined<ap_int<3>>);

}  // namespace
}  // namespace hitpipe::hls::domain_test
