// + - * / % and unary minus against exact integers: results are wide enough and never wrap. Division rounds
// toward zero, the remainder has the dividend's sign, and both are defined by zero. Compound assignment wraps
// to the width of its left side.
#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_arithmetic_test {
namespace {

using exact::Integer;
using exact::Row;

constexpr auto multiply = [](const auto& a, const auto& b) { return a * b; };
constexpr auto divide = [](const auto& a, const auto& b) { return a / b; };
constexpr auto take_remainder = [](const auto& a, const auto& b) { return a % b; };

Integer product(const Row&, const Integer& a, const Integer& b) {
  return a * b;
}
/// By zero: all ones.
Integer quotient(const Row& row, const Integer& a, const Integer& b) {
  return b == 0 ? exact::wrapped(-1, row.result.width, row.result.is_signed) : Integer(a / b);
}
/// By zero: the dividend, cut to the result.
Integer remainder(const Row& row, const Integer& a, const Integer& b) {
  return b == 0 ? exact::wrapped(a, row.result.width, row.result.is_signed) : Integer(a % b);
}

TEST(ApIntArithmetic, IsExactInItsResultWidth) {
  exact::Run run(1);
  run.check("+", exact::rows([](const auto& a, const auto& b) { return a + b; }),
            [](const Row&, const Integer& a, const Integer& b) { return Integer(a + b); });
  run.check("-", exact::rows([](const auto& a, const auto& b) { return a - b; }),
            [](const Row&, const Integer& a, const Integer& b) { return Integer(a - b); });
  run.check("*", exact::rows(multiply), product);
  run.check("/", exact::rows(divide), quotient);
  run.check("%", exact::rows(take_remainder), remainder);
  run.check_one_operand("-a", exact::rows_of_one([](const auto& a) { return -a; }),
                        [](const Row&, const Integer& a) { return Integer(-a); });
  run.finish(5 * exact::row_count * exact::pairs_per_row + exact::one_row_count * exact::values_per_row);
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

/// exactly(a, b), computed on the patterns of both in a wider width, and wrapped into a's type.
template <class Exactly>
auto wrapped_to_a(Exactly exactly) {
  return [exactly](const Row& row, const Integer& a, const Integer& b) {
    return exact::wrapped(exactly(exact::pattern(a, 300), exact::pattern(b, 300)), row.a.width,
                          row.a.is_signed);
  };
}

TEST(ApIntCompoundAssignment, WrapsToItsOwnWidth) {
  exact::Run run(36);
  run.check("+=", exact::crossed_rows([](auto a, const auto& b) { return a += b; }),
            wrapped_to_a([](const Integer& a, const Integer& b) { return Integer(a + b); }));
  run.check("-=", exact::crossed_rows([](auto a, const auto& b) { return a -= b; }),
            wrapped_to_a([](const Integer& a, const Integer& b) { return Integer(a - b); }));
  run.check("*=", exact::crossed_rows([](auto a, const auto& b) { return a *= b; }),
            wrapped_to_a([](const Integer& a, const Integer& b) { return Integer(a * b); }));
  run.check("&=", exact::crossed_rows([](auto a, const auto& b) { return a &= b; }),
            wrapped_to_a([](const Integer& a, const Integer& b) { return Integer(a & b); }));
  run.check("|=", exact::crossed_rows([](auto a, const auto& b) { return a |= b; }),
            wrapped_to_a([](const Integer& a, const Integer& b) { return Integer(a | b); }));
  run.check("^=", exact::crossed_rows([](auto a, const auto& b) { return a ^= b; }),
            wrapped_to_a([](const Integer& a, const Integer& b) { return Integer(a ^ b); }));
  run.finish(6 * exact::crossed_row_count * exact::pairs_per_row);
}

TEST(ApIntCompoundAssignment, DividesAsTheOperatorDoes) {
  exact::Run run(37);
  run.check("/=", exact::crossed_rows([](auto a, const auto& b) { return a /= b; }),
            [](const Row& row, const Integer& a, const Integer& b) {
              return exact::wrapped(b == 0 ? Integer(-1) : Integer(a / b), row.a.width, row.a.is_signed);
            });
  run.check("%=", exact::crossed_rows([](auto a, const auto& b) { return a %= b; }),
            [](const Row& row, const Integer& a, const Integer& b) {
              // By zero it is the dividend, cut to the type of a % b.
              const int reach =
                  std::min(row.a.width, row.b.width + (row.a.is_signed && !row.b.is_signed ? 1 : 0));
              return b == 0 ? exact::wrapped(a, reach, row.a.is_signed) : Integer(a % b);
            });
  run.finish(2 * exact::crossed_row_count * exact::pairs_per_row);
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_arithmetic_test
