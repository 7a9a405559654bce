// (a, b) and a.concat(b), read and written in place, against exact bit patterns.
#include <gtest/gtest.h>

#include "tests/hls/num/run.hpp"

namespace hitpipe::hls::ap_int_concat_test {
namespace {

using exact::Integer;
using exact::Row;

TEST(ApIntConcatenation, PutsTheLeftAboveTheRight) {
  exact::Run run(46);
  const auto both = [](const Row& row, const Integer& a, const Integer& b) {
    const Integer high = exact::pattern(a, row.a.width) << static_cast<unsigned>(row.b.width);
    return Integer(high + exact::pattern(b, row.b.width));
  };
  run.check("(a, b)", exact::crossed_rows([](const auto& a, const auto& b) { return (a, b).value(); }), both);
  run.check("concat", exact::crossed_rows([](const auto& a, const auto& b) { return a.concat(b).value(); }),
            both);
  run.finish(2 * exact::crossed_row_count * exact::pairs_per_row);
}

TEST(ApIntConcatenation, IsWrittenToBothSides) {
  exact::Run run(47);
  // (a, b) after its own value with all bits flipped was written to it.
  run.check("(a, b) = ~(a, b), left", exact::crossed_rows([](auto a, auto b) {
              (a, b) = ~(a, b);
              return a;
            }),
            [](const Row& row, const Integer& a, const Integer&) {
              return exact::wrapped(-a - 1, row.a.width, row.a.is_signed);
            });
  run.check("(a, b) = ~(a, b), right", exact::crossed_rows([](auto a, auto b) {
              (a, b) = ~(a, b);
              return b;
            }),
            [](const Row& row, const Integer&, const Integer& b) {
              return exact::wrapped(-b - 1, row.b.width, row.b.is_signed);
            });
  run.finish(2 * exact::crossed_row_count * exact::pairs_per_row);
}

TEST(ApIntConcatenation, NestsAndTakesBitsRangesAndCppIntegers) {
  ap_uint<8> a = 0xa5;
  ap_int<4> b = -2;
  ap_uint<1> c = 1;
  EXPECT_EQ((a, b, c), 0x14bd);
  EXPECT_EQ((a(3, 0), b), 0x5e);
  EXPECT_EQ((a[7], c, b), 0x3e);
  EXPECT_EQ((c, true), 3);
  EXPECT_EQ((true, c), 3);
  EXPECT_EQ((static_cast<signed char>(-1), c), 0x1ff);
  (a, b, c) = 0x0a46;
  EXPECT_EQ(a, 0x52);
  EXPECT_EQ(b, 3);
  EXPECT_EQ(c, 0);
  (a[0], b) = 0x18;
  EXPECT_EQ(a, 0x53);
  EXPECT_EQ(b, -8);
  (a[0], b) = 0x23;
  EXPECT_EQ(a, 0x52);
  (a(7, 4), b) = 0xc7;
  EXPECT_EQ(a, 0xc2);
  EXPECT_EQ(b, 7);
  a.concat(b) = 0x123;
  EXPECT_EQ(a, 0x12);
  EXPECT_EQ(b, 3);
}

}  // namespace
}  // namespace hitpipe::hls::ap_int_concat_test
