// & | ^ ~ and shifts against the bit patterns of exact integers.
#include <iterator>
#include <limits>

#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_logic_test {
namespace {

using exact::Integer;
using exact::Row;

/// combine() on the operands' patterns in the result's width.
template <class Combine>
auto by_patterns(Combine combine) {
  return [combine](const Row& row, const Integer& a, const Integer& b) {
    const int width = row.result.width;
    const Integer bits = combine(exact::pattern(a, width), exact::pattern(b, width));
    return exact::wrapped(bits, width, row.result.is_signed);
  };
}

TEST(ApIntLogic, CombinesTheOperandsExtendedByTheirOwnSigns) {
  exact::Run run(11);
  run.check("&", exact::rows([](const auto& a, const auto& b) { return a & b; }),
            by_patterns([](const Integer& a, const Integer& b) { return Integer(a & b); }));
  run.check("|", exact::rows([](const auto& a, const auto& b) { return a | b; }),
            by_patterns([](const Integer& a, const Integer& b) { return Integer(a | b); }));
  run.check("^", exact::rows([](const auto& a, const auto& b) { return a ^ b; }),
            by_patterns([](const Integer& a, const Integer& b) { return Integer(a ^ b); }));
  run.finish(3 * exact::row_count * exact::pairs_per_row);
}

TEST(ApIntComplement, FlipsEveryBitAndKeepsTheType) {
  exact::Run run(12);
  run.check_one_operand("~", exact::rows_of_one([](const auto& a) { return ~a; }),
                        [](const Row& row, const Integer& a) {
                          EXPECT_EQ(row.result.width, row.a.width);
                          return exact::wrapped(-a - 1, row.a.width, row.a.is_signed);
                        });
  run.check_one_operand("+a", exact::rows_of_one([](const auto& a) { return +a; }),
                        [](const Row&, const Integer& a) { return a; });
  run.finish(2 * exact::one_row_count * exact::values_per_row);
}

Integer shifted_left(const Row& row, const Integer& a, int n) {
  return exact::wrapped(a << static_cast<unsigned>(n), row.a.width, row.a.is_signed);
}
/// Rounds down, which is what filling with the sign does.
Integer shifted_right(const Integer& a, int n) {
  return Integer(a - exact::pattern(a, n)) / exact::power_of_two(n);
}

/// Counts below, at and beyond the width.
exact::Choice shift_count_for(const exact::Type& type, std::mt19937_64& random) {
  const int w = type.width;
  const int counts[] = {0, 1,     w / 2, w - 1,
                        w, w + 1, 200,   static_cast<int>(random() % static_cast<unsigned>(w))};
  return {0, counts[random() % std::size(counts)], 0};
}

constexpr auto shift_variants = []<class A>(A a, const exact::Choice& choice) {
  const int n = choice.i;
  const auto un = static_cast<unsigned>(n);
  switch (choice.variant) {
    case 0:
      return a << n;
    case 1:
      return a << un;
    case 2:
      return a << ap_uint<8>(n);
    case 3:
      return a <<= ap_uint<70>(n);
    case 4:
      return a >> -n;
    case 5:
      return a >> n;
    case 6:
      return a >> un;
    case 7:
      return a >> ap_uint<8>(n);
    case 8:
      return a >>= ap_uint<70>(n);
    default:
      return a << -n;
  }
};

// A negative C++ integer shifts the other way.
TEST(ApIntShift, KeepsTheWidthAndFillsWithTheSign) {
  exact::Run run(13);
  run.check_choices({"<< int", "<< unsigned", "<< ap_uint", "<<=", ">> -n", ">> int", ">> unsigned",
                     ">> ap_uint", ">>=", "<< -n"},
                    exact::rows_of_choice(shift_variants), shift_count_for,
                    [](const Row& row, const Integer& a, const exact::Choice& choice) {
                      return choice.variant < 5 ? shifted_left(row, a, choice.i) : shifted_right(a, choice.i);
                    });
  run.finish(10 * exact::choice_row_count * exact::values_per_row);
}

TEST(ApIntShift, ByMoreThanAnIntHoldsEmptiesTheValue) {
  const ap_uint<100> far = ap_uint<100>(1) << 99;
  EXPECT_TRUE((ap_uint<40>(-1) << far).is_zero());
  EXPECT_TRUE((ap_uint<40>(-1) >> far).is_zero());
  EXPECT_EQ(ap_int<40>(-7) >> far, -1);
  EXPECT_EQ(ap_int<40>(-7) >> (std::uint64_t{1} << 63), -1);
  EXPECT_TRUE((ap_int<40>(-7) << (std::int64_t{1} << 40)).is_zero());
  EXPECT_EQ(ap_int<40>(-7) << std::numeric_limits<std::int64_t>::min(), -1);
}

TEST(ApIntShift, OfWideValuesCrossesLimbs) {
  exact::Run run(16);
  std::vector<Row> left;
  std::vector<Row> right;
  const auto shl = [](const auto& a, const auto& n) { return a << n; };
  const auto shr = [](const auto& a, const auto& n) { return a >> n; };
  exact::with_types(
      [&]<class A>() {
        left.push_back(exact::row<decltype(shl), A, ap_uint<8>>());
        right.push_back(exact::row<decltype(shr), A, ap_uint<8>>());
      },
      exact::Widths<129, 192, 310, 512>{});
  for (int n = 0; n < 256; n += 5) {
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Integer a = exact::random_value(left[i].a, run.random());
      run.check_one("<<", left[i], a, n, shifted_left(left[i], a, n));
      run.check_one(">>", right[i], a, n, shifted_right(a, n));
    }
  }
  run.finish(2 * 8 * 52);
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_logic_test
