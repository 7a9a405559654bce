// balance(): divides a component's logic into stages so that none is much longer than the others.
#include "rtl_gen/schedule/divided_unit.hpp"

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "rtl_gen/schedule/registers.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"

namespace hitpipe::rtl::divided_unit_test {
namespace {

/// `length` multiplexers in a row: 2 gate levels each.
Graph chain(int length) {
  Graph g("chain");
  const NodeId choose = g.input("choose", 1, false);
  const NodeId a = g.input("a", 8, false);
  NodeId last = g.input("b", 8, false);
  for (int i = 0; i < length; ++i) last = g.mux(choose, i % 2 == 0 ? a : g.invert(a), last);
  g.output("o", last);
  return g;
}

constexpr int product_levels = 30;  // schedule/logic_levels.json, int_multiply up to 32 bits

/// Multiplexers in each stage.
std::vector<int> shares(const Graph& graph, const Schedule& schedule) {
  std::vector<int> counts(static_cast<std::size_t>(schedule.stages), 0);
  for (NodeId id = 0; id < graph.size(); ++id) {
    if (graph[id].op == Op::mux) ++counts[static_cast<std::size_t>(schedule.slots[id].stage - 1)];
  }
  return counts;
}

TEST(Balance, DividesAChainEvenly) {
  const Graph graph = chain(12);
  EXPECT_EQ(shares(graph, balance(graph, 1)), (std::vector<int>{12}));
  EXPECT_EQ(shares(graph, balance(graph, 3)), (std::vector<int>{4, 4, 4}));
  EXPECT_EQ(shares(graph, balance(graph, 4)), (std::vector<int>{3, 3, 3, 3}));
  EXPECT_EQ(shares(graph, balance(graph, 5)), (std::vector<int>{3, 3, 3, 3, 0}));
  EXPECT_EQ(balance(graph, 5).clock_ps, 3 * 2 + 1);
}

TEST(Balance, ShallowLogicWaitsForTheLastStage) {
  const Graph graph = chain(2);
  const Schedule schedule = balance(graph, 4);
  EXPECT_EQ(schedule.stages, 4);
  EXPECT_EQ(shares(graph, schedule), (std::vector<int>{1, 1, 0, 0}));
  const Placement placement = place_registers(graph, schedule, Ports::direct);
  const auto at_the_end = std::count_if(placement.registers.begin(), placement.registers.end(),
                                        [](const Register& r) { return r.boundary == 3; });
  EXPECT_EQ(at_the_end, 1) << "the result";
}

TEST(Balance, NoStageRejected) {
  EXPECT_EQ(message_of<std::invalid_argument>([] { static_cast<void>(balance(chain(2), 0)); }),
            "chain: a component has at least one stage");
}

// No stage of a float unit is longer than an even share of the logic plus its longest node, a product.
TEST(Balance, FloatUnitsHaveEvenStages) {
  int units = 0;
  for (const char* design : {"fp_slabs", "fp_plucker"}) {
    const Graph graph = find_design(design).trace(Format(hls::Binary32{}));
    for (const auto& unit : graph.submodules()) {
      const int whole = balance(unit->body, 1).clock_ps;
      for (const int stages : {5, 7}) {
        const int clock = balance(unit->body, stages).clock_ps;
        EXPECT_LE(clock, whole / stages + product_levels) << unit->body.name() << " in " << stages;
        EXPECT_GE(clock * stages, whole) << unit->body.name();
      }
      ++units;
    }
  }
  EXPECT_EQ(units, 6);
}

}  // namespace
}  // namespace hitpipe::rtl::divided_unit_test
