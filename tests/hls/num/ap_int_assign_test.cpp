// Compound assignment against exact integers: it wraps to the width of its left side.
#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_assign_test {
namespace {

using exact::Integer;
using exact::Row;

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
}  // namespace hitpipe::hls::ap_int_assign_test
