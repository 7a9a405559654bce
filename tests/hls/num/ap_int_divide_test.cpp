// / and % against exact integers: rounding toward zero, the remainder with the dividend's sign, and defined
// by zero.
#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_divide_test {
namespace {

using exact::Integer;
using exact::Row;

constexpr auto divide = [](const auto& a, const auto& b) { return a / b; };
constexpr auto take_remainder = [](const auto& a, const auto& b) { return a % b; };

/// By zero: all ones.
Integer quotient(const Row& row, const Integer& a, const Integer& b) {
  return b == 0 ? exact::wrapped(-1, row.result.width, row.result.is_signed) : Integer(a / b);
}
/// By zero: the dividend, cut to the result.
Integer remainder(const Row& row, const Integer& a, const Integer& b) {
  return b == 0 ? exact::wrapped(a, row.result.width, row.result.is_signed) : Integer(a % b);
}

TEST(ApIntDivision, IsExactInItsResultWidth) {
  exact::Run run(21);
  run.check("/", exact::rows(divide), quotient);
  run.check("%", exact::rows(take_remainder), remainder);
  run.finish(2 * exact::row_count * exact::pairs_per_row);
}

TEST(ApIntDivision, OfWideValuesIsExact) {
  exact::Run run(22);
  std::vector<Row> quotients;
  std::vector<Row> remainders;
  exact::with_types(
      [&]<class A>() {
        quotients.push_back(exact::row<decltype(divide), A, ap_int<200>>());
        remainders.push_back(exact::row<decltype(take_remainder), A, ap_uint<192>>());
      },
      exact::Widths<129, 192, 256>{});
  run.check("/", quotients, quotient);
  run.check("%", remainders, remainder);
  run.finish(2 * 6 * exact::pairs_per_row);
}

TEST(ApIntDivision, ByZeroGivesAllOnesAndTheDividend) {
  EXPECT_EQ(ap_uint<8>(200) / ap_uint<8>(0), 255);
  EXPECT_EQ(ap_int<8>(-100) / ap_int<8>(0), -1);
  EXPECT_EQ(ap_uint<8>(200) % ap_uint<8>(0), 200);
  EXPECT_EQ(ap_int<8>(-100) % ap_int<8>(0), -100);
  EXPECT_EQ(ap_uint<8>(200) % ap_uint<4>(0), 8);
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_divide_test
