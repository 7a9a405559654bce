// Comparisons, and conversions between widths, signs and C++ integers, against exact integers.
#include <limits>

#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_compare_test {
namespace {

using exact::Integer;
using exact::Row;

// All six comparisons at once, one bit each: == != < <= > >= from the lowest bit.
TEST(ApIntComparison, IsExactAcrossWidthsAndSigns) {
  exact::Run run(31);
  const auto compare = [](const auto& a, const auto& b) {
    return (a == b) | (a != b) << 1 | (a < b) << 2 | (a <= b) << 3 | (a > b) << 4 | (a >= b) << 5;
  };
  run.check("== != < <= > >=", exact::rows(compare),
            [compare](const Row&, const Integer& a, const Integer& b) { return Integer(compare(a, b)); });
  run.finish(exact::row_count * exact::pairs_per_row);
}

TEST(ApIntConversion, ExtendsByTheSourcesSignAndWraps) {
  exact::Run run(32);
  run.check("=", exact::rows([](auto a, const auto& b) { return a = b; }),
            [](const Row& row, const Integer&, const Integer& b) {
              return exact::wrapped(b, row.a.width, row.a.is_signed);
            });
  run.finish(exact::row_count * exact::pairs_per_row);
}

TEST(ApIntConversion, ToCppIntegersKeepsTheLowBitsExtendedByTheSign) {
  exact::Run run(33);
  const auto convert = [](const auto& a, const exact::Choice& choice) -> ap_int<65> {
    switch (choice.variant) {
      case 0:
        return a.to_int();
      case 1:
        return a.to_uint();
      case 2:
        return a.to_int64();
      case 3:
        return a.to_uint64();
      case 4:
        return a.to_bool();
      case 5:
        return !a;
      default:
        return a.sign();
    }
  };
  run.check_choices(
      {"to_int", "to_uint", "to_int64", "to_uint64", "to_bool", "!", "sign"}, exact::rows_of_choice(convert),
      [](const exact::Type&, std::mt19937_64&) { return exact::Choice(0, 0, 0); },
      [](const Row&, const Integer& a, const exact::Choice& choice) {
        switch (choice.variant) {
          case 0:
            return exact::wrapped(a, 32, true);
          case 1:
            return exact::wrapped(a, 32, false);
          case 2:
            return exact::wrapped(a, 64, true);
          case 3:
            return exact::wrapped(a, 64, false);
          case 4:
            return Integer(a != 0);
          case 5:
            return Integer(a == 0);
          default:
            return Integer(a < 0);
        }
      });
  run.finish(7 * exact::choice_row_count * exact::values_per_row);
}

/// An operation between every C++ integer type and some ap types; the C++ integer comes second.
template <class Op>
std::vector<Row> cpp_integer_rows(Op) {
  std::vector<Row> rows;
  const auto add = [&rows]<class A, class C>() {
    using R = std::remove_cvref_t<decltype(Op{}(A(), C()))>;
    rows.push_back({exact::type_of<A>, exact::type_of<C>, exact::type_of<R>,
                    [](const exact::Raw& a, const exact::Raw& c) {
                      return exact::raw_of(value_of(Op{}(exact::make<A>(a), static_cast<C>(c[0]))));
                    }});
  };
  exact::with_types(
      [&add]<class A>() {
        add.template operator()<A, bool>();
        add.template operator()<A, char>();
        add.template operator()<A, signed char>();
        add.template operator()<A, unsigned char>();
        add.template operator()<A, short>();
        add.template operator()<A, unsigned short>();
        add.template operator()<A, int>();
        add.template operator()<A, unsigned>();
        add.template operator()<A, long>();
        add.template operator()<A, unsigned long>();
        add.template operator()<A, long long>();
        add.template operator()<A, unsigned long long>();
      },
      exact::Widths<24, 64, 100>{});
  return rows;
}

TEST(ApIntWithCppIntegers, CountsTheirOwnWidthAndSignOnEitherSide) {
  exact::Run run(34);
  run.check("a + c", cpp_integer_rows([](const auto& a, auto c) { return a + c; }),
            [](const Row&, const Integer& a, const Integer& c) { return Integer(a + c); });
  run.check("c - a", cpp_integer_rows([](const auto& a, auto c) { return c - a; }),
            [](const Row&, const Integer& a, const Integer& c) { return Integer(c - a); });
  run.check("c * a", cpp_integer_rows([](const auto& a, auto c) { return c * a; }),
            [](const Row&, const Integer& a, const Integer& c) { return Integer(c * a); });
  run.check("a < c, c == a", cpp_integer_rows([](const auto& a, auto c) { return (a < c) | (c == a) << 1; }),
            [](const Row&, const Integer& a, const Integer& c) { return Integer((a < c) | (c == a) << 1); });
  run.check("a = c", cpp_integer_rows([](auto a, auto c) { return a = c; }),
            [](const Row& row, const Integer&, const Integer& c) {
              return exact::wrapped(c, row.a.width, row.a.is_signed);
            });
  run.finish(5 * 6 * 12 * exact::pairs_per_row);
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_compare_test
