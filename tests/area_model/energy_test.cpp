// The energy of a test follows from what its operands change.
#include "area_model/energy.hpp"

#include <cstdint>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

namespace hitpipe::area::energy_test {
namespace {

using Tests = std::vector<std::vector<std::int64_t>>;

/// One subtracter of eight bits.
rtl::Graph difference() {
  rtl::Graph graph("difference");
  const rtl::NodeId a = graph.input("a", 8, false);
  const rtl::NodeId b = graph.input("b", 8, false);
  graph.output("d", graph.binary(rtl::Op::sub, a, b));
  return graph;
}

class Energy : public testing::Test {
 protected:
  [[nodiscard]] Toggles of(const Tests& tests) const { return toggles_of(pipeline_, library_, tests); }

  const rtl::Library library_ = rtl::library_called("osu018");
  const rtl::Pipeline pipeline_ = rtl::make_pipeline(difference(), library_);
  const double area_ = library_.cell(rtl::Component::int_subtract, 8).area_um2;
};

TEST_F(Energy, LogicTakesTheShareOfOperandBitsThatChange) {
  EXPECT_EQ(of({{3, 5}, {3, 5}, {3, 5}}).logic_um2, 0);
  EXPECT_DOUBLE_EQ(of({{0, 0}, {255, 255}}).logic_um2, area_) << "all 16 bits";
  EXPECT_DOUBLE_EQ(of({{0, 0}, {255, 0}, {0, 0}}).logic_um2, area_ / 2) << "8 of 16, in each of two tests";
  EXPECT_DOUBLE_EQ(of({{0, 0}, {1, 0}}).logic_um2, area_ / 16);
}

TEST_F(Energy, TheClockReachesEachRegisterBit) {
  const Toggles still = of({{3, 5}, {3, 5}});
  EXPECT_EQ(still.register_bits, 8 + 8 + 8) << "two operands and the result";
  EXPECT_EQ(still.shared_um2, 0);
  EXPECT_EQ(still.pipelined_um2, 0);
  EXPECT_GT(energy_pj(still, 1), 0);
  EXPECT_DOUBLE_EQ(energy_pj(still, 3), 3 * energy_pj(still, 1)) << "nothing but the clock";
  EXPECT_GT(energy_pj(of({{0, 0}, {255, 255}}), 1), energy_pj(still, 1));
}

TEST_F(Energy, NeedsTwoTests) {
  EXPECT_THROW((void)of({{1, 2}}), std::invalid_argument);
}

}  // namespace
}  // namespace hitpipe::area::energy_test
