// The triangle unit that false hits are priced with: the operators of Moeller and Trumbore, and nothing else.
#include "area_model/triangle_unit.hpp"

#include <map>

#include <gtest/gtest.h>

namespace hitpipe::area::triangle_unit_test {
namespace {

using rtl::Component;

TEST(TriangleUnit, HasTheOperatorsOfMoellerAndTrumbore) {
  const Price price = price_of_triangle_unit(rtl::Library::thesis());
  std::map<Component, int> operators;
  for (const Line& line : price.lines)
    if (line.part.component != Component::latch) operators[line.part.component] += line.n;
  // Three differences of points, two cross products, four dot products, u + v; length times determinant.
  EXPECT_EQ(operators, (std::map<Component, int>{{Component::fp_subtract, 9 + 2 * 3 + 4 * 2 + 1},
                                                 {Component::fp_multiply, 2 * 6 + 4 * 3 + 1},
                                                 {Component::fp_compare, 2}}));
}

TEST(TriangleUnit, BeginsATestInEachCycleOfTheFloatClock) {
  const Price price = price_of_triangle_unit(rtl::Library::thesis());
  const Price slabs =
      area::price(rtl::find_design("fp_slabs"), hls::Binary32{}, rtl::Library::thesis(), Account::built);
  EXPECT_EQ(price.boxes, 1);
  EXPECT_EQ(price.stage_delay_ps, slabs.stage_delay_ps);
  EXPECT_GT(price.stages, 2 * slabs.stages);
  EXPECT_GT(price.area_um2, 4 * slabs.area_um2);
}

}  // namespace
}  // namespace hitpipe::area::triangle_unit_test
