// + - * and unary minus against exact integers: results are wide enough and never wrap.
#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_sum_test {
namespace {

using exact::Integer;
using exact::Row;

TEST(ApIntSum, IsExactInItsResultWidth) {
  exact::Run run(1);
  run.check("+", exact::rows([](const auto& a, const auto& b) { return a + b; }),
            [](const Row&, const Integer& a, const Integer& b) { return Integer(a + b); });
  run.finish(exact::row_count * exact::pairs_per_row);
}

TEST(ApIntDifference, IsExactInItsResultWidth) {
  exact::Run run(2);
  run.check("-", exact::rows([](const auto& a, const auto& b) { return a - b; }),
            [](const Row&, const Integer& a, const Integer& b) { return Integer(a - b); });
  run.finish(exact::row_count * exact::pairs_per_row);
}

constexpr auto multiply = [](const auto& a, const auto& b) { return a * b; };
Integer product(const Row&, const Integer& a, const Integer& b) {
  return a * b;
}

TEST(ApIntProduct, IsExactInItsResultWidth) {
  exact::Run run(3);
  run.check("*", exact::rows(multiply), product);
  run.finish(exact::row_count * exact::pairs_per_row);
}

// Results up to 512 bits, the widest allowed.
TEST(ApIntProduct, OfWideOperandsIsExact) {
  exact::Run run(4);
  std::vector<Row> rows;
  exact::with_types(
      [&rows]<class A>() {
        rows.push_back(exact::row<decltype(multiply), A, ap_base<512 - A::width, !A::is_signed>>());
      },
      exact::Widths<130, 192, 200, 255, 256>{});
  run.check("*", rows, product);
  run.finish(10 * exact::pairs_per_row);
}

TEST(ApIntNegation, IsExact) {
  exact::Run run(5);
  run.check_one_operand("-a", exact::rows_of_one([](const auto& a) { return -a; }),
                        [](const Row&, const Integer& a) { return Integer(-a); });
  run.finish(exact::one_row_count * exact::values_per_row);
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_sum_test
