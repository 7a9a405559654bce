// The listing of docs/fit.md compiles as it is shown, and its unit has what the demands leave.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/pipeline.hpp"
#include "rtl_gen/prune/prune.hpp"

/// A unit for rays without an end, whose y starts near the middle, and for boxes with x in order.
hitpipe::rtl::Pipeline fitted_slabs() {
  using namespace hitpipe::rtl;
  const Demands demands{{{"rinf", {{1, 1}}}, {"iry", {{-100, 100}}}}, {{"ixmin", "ixmax"}}};
  const Pruned fitted = prune(find_design("int_slabs").trace(hitpipe::hls::IntBits{20, 24}), demands);
  return make_pipeline(fitted.graph, library_called("thesis_250nm"));
}

namespace hitpipe::rtl::listing_test {
namespace {

TEST(Listing, MakesAUnitWithWhatTheDemandsLeave) {
  const std::vector<Port> ports = input_ports(fitted_slabs().graph);
  const auto named = [](const char* name) { return testing::Field(&Port::name, testing::Eq(name)); };
  EXPECT_THAT(ports, testing::Not(testing::Contains(named("rinf"))));
  EXPECT_THAT(ports, testing::Contains(testing::AllOf(named("iry"), testing::Field(&Port::width, 8))));
  EXPECT_THAT(ports, testing::Contains(testing::AllOf(named("irx"), testing::Field(&Port::width, 20))));
}

}  // namespace
}  // namespace hitpipe::rtl::listing_test
