// Operations that follow each other in one stage along carry chains.
#include "rtl_gen/schedule/chaining.hpp"

#include <gtest/gtest.h>

namespace hitpipe::rtl::chaining_test {
namespace {

/// An adder takes 1000 ps and 100 a bit, a comparator 1500, a multiplexer 300, a gate 200.
const Library& chip() {
  static const Library library = Library::from_json(R"({
    "name": "chip", "chip": {"device": "a chip", "estimated": true, "lut_inputs": 4,
      "register": {"delay_ps": 50},
      "gate": {"delay_ps": 200, "luts_pct": 100}, "mux2": {"delay_ps": 300, "luts_pct": 100},
      "carry": {"delay_ps": 1000, "compare_delay_ps": 1500, "delay_ps_per_bit": 100, "luts_pct": 100}}})",
                                                    "chip.json");
  return library;
}

constexpr int long_clock_ps = 1'000'000;

struct Chain {
  Graph g{"chain"};
  NodeId a = g.input("a", 10, false);
  NodeId b = g.input("b", 10, false);
  NodeId sum = g.binary(Op::add, a, b);

  /// When all its bits are there.
  [[nodiscard]] int ready(NodeId id) {
    g.output("o", id);
    return schedule_asap(g, chip(), long_clock_ps).slots[id].ready_ps;
  }
};

TEST(Chaining, ASumNeedNotWaitForTheHighBitsOfASum) {
  Chain c;
  EXPECT_EQ(c.ready(c.g.binary(Op::add, c.sum, c.b)), 1000 + 1000 + 10 * 100);
}

TEST(Chaining, ASumOfHighBitsWaitsForTheLowestOfThem) {
  Chain c;
  const NodeId high = c.g.slice(c.sum, 9, 4);
  EXPECT_EQ(c.ready(c.g.binary(Op::add, high, c.g.slice(c.b, 5, 0))), 1000 + 4 * 100 + 1000 + 6 * 100);
}

TEST(Chaining, AShiftUpwardsCostsNothing) {
  Chain c;
  const NodeId shifted = c.g.concat(c.sum, c.g.constant(2, 0));
  const NodeId wide = c.g.extend(c.b, 12, false);
  EXPECT_EQ(c.ready(c.g.binary(Op::add, shifted, wide)), 1000 + 1000 + 12 * 100);
}

TEST(Chaining, AComparisonEndsWithItsHighestBit) {
  Chain c;
  const NodeId less = c.g.binary(Op::less, c.sum, c.b);
  EXPECT_EQ(c.ready(less), 1000 + 1500 + 10 * 100);
  EXPECT_EQ(schedule_asap(c.g, chip(), long_clock_ps).slots[less].low_ps, 1000 + 1500 + 10 * 100);
}

TEST(Chaining, AMultiplexerPassesBitsInTheirOrderButWaitsForItsCondition) {
  Chain of_sum;
  const NodeId condition = of_sum.g.input("condition", 1, false);
  const NodeId chosen = of_sum.g.mux(condition, of_sum.sum, of_sum.a);
  EXPECT_EQ(of_sum.ready(of_sum.g.binary(Op::add, chosen, of_sum.b)), 1000 + 300 + 1000 + 10 * 100);
  Chain of_less;
  const NodeId less = of_less.g.binary(Op::less, of_less.a, of_less.b);
  const NodeId smaller = of_less.g.mux(less, of_less.a, of_less.b);
  EXPECT_EQ(of_less.ready(of_less.g.binary(Op::add, smaller, of_less.b)), 2500 + 300 + 2000);
}

TEST(Chaining, TheHighestBitOfASumIsTheLast) {
  Chain c;
  const NodeId sign = c.g.extend(c.g.slice(c.sum, 9, 9), 10, true);
  EXPECT_EQ(c.ready(c.g.binary(Op::bit_and, sign, c.b)), 2000 + 200);
  EXPECT_EQ(c.ready(c.g.binary(Op::add, sign, c.b)), 1000 + 9 * 100 + 1000 + 10 * 100);
}

/// A subtrahend out of a latch or a sum is inverted in a table of its own; a table that makes it inverts it
/// too.
TEST(Chaining, ASubtrahendIsInvertedFirst) {
  std::string json(R"({"name": "iCE", "chip": {"device": "a chip", "estimated": true, "lut_inputs": 4,
      "register": {"delay_ps": 50},
      "gate": {"delay_ps": 200, "luts_pct": 100}, "mux2": {"delay_ps": 300, "luts_pct": 100},
      "carry": {"delay_ps": 1000, "compare_delay_ps": 1500, "delay_ps_per_bit": 100, "subtrahend_delay_ps": 250,
                "luts_pct": 100}}})");
  const Library library = Library::from_json(json, "ice.json");
  Chain c;
  const NodeId latched = c.g.binary(Op::sub, c.sum, c.b);
  const NodeId of_sum = c.g.binary(Op::sub, c.b, c.sum);
  const NodeId of_gate = c.g.binary(Op::sub, c.b, c.g.binary(Op::bit_and, c.a, c.b));
  const NodeId constant = c.g.binary(Op::sub, c.a, c.g.constant(10, 3));
  const NodeId compared = c.g.binary(Op::less, c.a, c.b);
  for (const NodeId id : {latched, of_sum, of_gate, constant, compared}) c.g.output("o", id);
  const Schedule s = schedule_asap(c.g, library, long_clock_ps);
  EXPECT_EQ(s.slots[latched].ready_ps, 1000 + 1000 + 1000) << "the subtrahend waits for the sum";
  EXPECT_EQ(s.slots[of_sum].ready_ps, 1000 + 250 + 1000 + 1000);
  EXPECT_EQ(s.slots[of_gate].ready_ps, 200 + 1000 + 1000);
  EXPECT_EQ(s.slots[constant].ready_ps, 1000 + 1000);
  EXPECT_EQ(s.slots[compared].ready_ps, 250 + 1500 + 1000);
  Graph alone("alone");
  alone.output("o", alone.binary(Op::sub, alone.input("a", 10, false), alone.input("b", 10, false)));
  EXPECT_EQ(schedule_asap(alone, library).clock_ps, 250 + 1000 + 1000 + 50)
      << "the shortest clock has it too";
}

TEST(Chaining, CarryTreesOfCellsHaveNoOrder) {
  const Library& cells = Library::thesis();
  EXPECT_EQ(cells.carry_delay_ps_per_bit(), 0);
  EXPECT_EQ(cells.timing(Component::int_subtract, 24).ripple_ps, 0);
}

}  // namespace
}  // namespace hitpipe::rtl::chaining_test
