// The divider of a ray's set-up has a subtracter, its registers and their multiplexers.
#include "area_model/set_up.hpp"

#include <gtest/gtest.h>

namespace hitpipe::area::set_up_test {
namespace {

TEST(DividerPrice, HasASubtracterAndItsRegisters) {
  const rtl::Library& library = rtl::Library::thesis();
  const DividerPrice price = divider_price({.count = 3, .quotient_bits = 15}, library);
  const int registers = 24 + 24 + 15;
  EXPECT_GE(price.area_um2, library.cell(rtl::Component::int_subtract, 25).area_um2 +
                                library.cell(rtl::Component::latch, registers).area_um2);
  EXPECT_GT(price.clock_ps, library.cell(rtl::Component::int_subtract, 25).delay_ps);
  EXPECT_EQ(price.luts, 0);
}

TEST(DividerPrice, GrowsWithTheQuotientAndNotWithTheirNumber) {
  const rtl::Library& library = rtl::Library::thesis();
  const DividerPrice narrow = divider_price({.count = 3, .quotient_bits = 9}, library);
  EXPECT_GT(divider_price({.count = 3, .quotient_bits = 25}, library).area_um2, narrow.area_um2);
  EXPECT_EQ(divider_price({.count = 1, .quotient_bits = 9}, library).area_um2, narrow.area_um2);
}

TEST(DividerPrice, OnAChipIsInLookupTables) {
  const DividerPrice price = divider_price({.count = 3, .quotient_bits = 15}, rtl::library_called("xc7"));
  EXPECT_GT(price.luts, 24);
  EXPECT_EQ(price.area_um2, 0);
}

}  // namespace
}  // namespace hitpipe::area::set_up_test
