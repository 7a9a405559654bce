// verify(): a legal schedule damaged in one place, once for each rule; and unusual schedules that are legal.
#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/schedule.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/schedule/random_schedule.hpp"

namespace hitpipe::rtl::verify_test {
namespace {

using Broken = std::vector<std::string>;

/// m = c ? a : b (stage 1), p = m * b (stages 2-3), g = low half of p & a (stage 4), h = g | b (stage 4).
class DamagedSchedule : public testing::Test {
 protected:
  DamagedSchedule() {
    g.annotate(m, "m", {});
    g.annotate(p, "p", {});
    g.annotate(h, "h", {});
    g.output("o", h);
    s = schedule_asap(g, library);
  }
  [[nodiscard]] Broken broken() const { return verify(g, library, s); }

  Library library = unit_library();
  Graph g{"damaged"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, true);
  NodeId c = g.input("c", 1, false);
  NodeId m = g.mux(c, a, b);
  NodeId p = g.binary(Op::mul, m, b, true);
  NodeId gate = g.binary(Op::bit_and, g.slice(p, 7, 0), a);
  NodeId h = g.binary(Op::bit_or, gate, b);
  Schedule s;
};

TEST_F(DamagedSchedule, UndamagedIsLegal) {
  EXPECT_EQ(s.stages, 4);
  EXPECT_EQ(s.clock_ps, 11);
  EXPECT_EQ(broken(), Broken{});
}

TEST_F(DamagedSchedule, MissingSlotsRejected) {
  s.slots.pop_back();
  EXPECT_EQ(broken(), Broken{"7 slots for 8 nodes"});
}

TEST_F(DamagedSchedule, InputNotOutOfALatchRejected) {
  s.slots[a].latched = false;
  EXPECT_EQ(broken(), Broken{"input a is not at stage 0"});
}

TEST_F(DamagedSchedule, InputInALaterStageRejected) {
  s.slots[b].finish = 1;
  EXPECT_EQ(broken().front(), "input b is not at stage 0");
}

TEST_F(DamagedSchedule, NodeBeforeTheFirstStageRejected) {
  s.slots[m].stage = s.slots[m].finish = 0;
  EXPECT_EQ(broken(),
            (Broken{"m starts in stage 0", "m starts in stage 0 but reads c, which is there in stage 1",
                    "m starts in stage 0 but reads a, which is there in stage 1",
                    "m starts in stage 0 but reads b, which is there in stage 1"}));
}

TEST(Verify, NodeBeforeItsStatedStageRejected) {
  const Library library = unit_library();
  Graph g("stated");
  const NodeId a = g.input("a", 1, false);
  const NodeId b = g.input("b", 1, false);
  g.begin_stage(2);
  const NodeId gate = g.binary(Op::bit_and, a, b);
  g.annotate(gate, "gate", {});
  g.output("o", gate);
  Schedule s = schedule_asap(g, library);
  EXPECT_EQ(s.slots[gate].stage, 2);
  EXPECT_EQ(verify(g, library, s), Broken{});
  s.slots[gate].stage = s.slots[gate].finish = 1;
  EXPECT_EQ(verify(g, library, s), Broken{"gate starts in stage 1 but states stage 2"});
}

TEST_F(DamagedSchedule, NoStagesRejected) {
  s.stages = 0;
  EXPECT_EQ(broken(), (Broken{"0 stages, at least 1 is needed",
                              "output o is latched in stage 0 but h is there in stage 4"}));
}

TEST_F(DamagedSchedule, CombinationalNodeOverTwoStagesRejected) {
  s.slots[gate].finish = 5;
  s.stages = 5;
  s.slots[h].stage = s.slots[h].finish = 5;
  EXPECT_EQ(broken(), Broken{"%6 (and) has 0 internal stages but occupies stages 4 to 5"});
}

TEST_F(DamagedSchedule, PipelinedComponentInTooFewStagesRejected) {
  s.slots[p].finish = 2;
  EXPECT_EQ(broken(), Broken{"p has 2 internal stages but occupies stages 2 to 2"});
}

TEST_F(DamagedSchedule, PipelinedComponentNotLatchedRejected) {
  s.slots[p].latched = false;
  EXPECT_EQ(broken(), Broken{"p has 2 internal stages but occupies stages 2 to 3"});
}

TEST_F(DamagedSchedule, CombinationalNodeLatchedRejected) {
  s.slots[m].latched = true;
  EXPECT_EQ(broken(), Broken{"m has 0 internal stages but occupies stages 1 to 1"});
}

TEST_F(DamagedSchedule, OperandThatIsNotThereYetRejected) {
  s.slots[gate].stage = s.slots[gate].finish = 3;
  EXPECT_EQ(broken(), Broken{"%6 (and) starts in stage 3 but reads p, which is there in stage 4"});
}

TEST_F(DamagedSchedule, ChainedOperandOfALaterStageRejected) {
  s.slots[gate].stage = s.slots[gate].finish = 5;
  EXPECT_EQ(broken(), Broken{"h starts in stage 4 but reads %6 (and), which is there in stage 5"});
}

TEST_F(DamagedSchedule, ChainLongerThanTheClockRejected) {
  s.slots[p].stage = 1;
  s.slots[p].finish = 2;
  EXPECT_EQ(broken(), Broken{"p: 12 ps of logic and a 1 ps latch exceed the clock of 11 ps"});
}

TEST_F(DamagedSchedule, ShorterClockRejected) {
  s.clock_ps = 10;
  EXPECT_EQ(broken(), Broken{"p: 10 ps of logic and a 1 ps latch exceed the clock of 10 ps"});
}

TEST_F(DamagedSchedule, ArrivalTimesAreNotTakenOnTrust) {
  s.slots[m].ready_ps = 0;
  s.slots[p].stage = 1;
  s.slots[p].finish = 2;
  EXPECT_EQ(broken(), Broken{"p: 12 ps of logic and a 1 ps latch exceed the clock of 11 ps"});
}

TEST_F(DamagedSchedule, OutputLatchedBeforeItsValueRejected) {
  s.stages = 3;
  EXPECT_EQ(broken(), Broken{"output o is latched in stage 3 but h is there in stage 4"});
}

/// p = a - b (stage 1), q = p + b (stage 2, as it states), r = q + p (stage 2).
class DamagedStatedSchedule : public testing::Test {
 protected:
  DamagedStatedSchedule() {
    p = g.binary(Op::sub, a, b);
    g.annotate(p, "p", {});
    g.begin_stage(2);
    q = g.binary(Op::add, p, b);
    g.annotate(q, "q", {});
    g.begin_stage(1);
    r = g.binary(Op::add, q, p);
    g.annotate(r, "r", {});
    g.output("o", r);
    s = schedule_as_stated(g, 2);
  }
  [[nodiscard]] Broken broken() const { return verify_stated(g, s); }
  void move(NodeId node, int stage) { s.slots[node].stage = s.slots[node].finish = stage; }

  Graph g{"damaged"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, true);
  NodeId p = no_node;
  NodeId q = no_node;
  NodeId r = no_node;
  Schedule s;
};

TEST_F(DamagedStatedSchedule, UndamagedIsLegal) {
  EXPECT_EQ(broken(), Broken{});
}

TEST_F(DamagedStatedSchedule, NodeBeforeItsStatedStageRejected) {
  move(q, 1);
  EXPECT_EQ(broken(), Broken{"q starts in stage 1 but states stage 2"});
}

TEST_F(DamagedStatedSchedule, NodeBeforeItsOperandRejected) {
  move(r, 1);
  EXPECT_EQ(broken(), Broken{"r starts in stage 1 but reads q, which is there in stage 2"});
}

TEST_F(DamagedStatedSchedule, NodeOverTwoStagesRejected) {
  s.slots[p].finish = 2;
  EXPECT_EQ(broken(), Broken{"p has 0 internal stages but occupies stages 1 to 2"});
}

TEST_F(DamagedStatedSchedule, OutputBeforeItsValueRejected) {
  s.stages = 1;
  EXPECT_EQ(broken(), Broken{"output o is latched in stage 1 but r is there in stage 2"});
}

TEST(Verify, AcceptsLegalSchedulesThatNobodyWouldMake) {
  constexpr int graphs = 400;
  Seeded random(137);
  const Library library = unit_library();
  int accepted = 0;
  for (int i = 0; i < graphs; ++i) {
    const Graph graph = canonical(Recipe(random, 5, 40, 4).graph());
    const int clock = schedule_asap(graph, library).clock_ps + random.below(20);
    const Schedule schedule = random_schedule(graph, library, clock, random);
    ASSERT_EQ(verify(graph, library, schedule), Broken{}) << to_text(graph);
    ++accepted;
  }
  EXPECT_EQ(accepted, graphs);
}

// After the last stage a node is too late for every reader, be it an operation or an output latch.
TEST(Verify, RejectsRandomSchedulesWithOneNodeTooLate) {
  constexpr int intended = 400;
  Seeded random(139);
  const Library library = unit_library();
  int damaged = 0;
  while (damaged < intended) {
    const Graph graph = canonical(Recipe(random, 5, 40, 4).graph());
    Schedule schedule = schedule_asap(graph, library);
    const auto id = static_cast<NodeId>(random.below(static_cast<int>(graph.size())));
    if (!is_root(graph[id].op) || graph[id].op == Op::input) continue;
    const int by = schedule.stages + 1 - schedule.slots[id].stage;
    schedule.slots[id].stage += by;
    schedule.slots[id].finish += by;
    ASSERT_NE(verify(graph, library, schedule), Broken{}) << "%" << id << "\n" << to_text(graph);
    ++damaged;
  }
}

}  // namespace
}  // namespace hitpipe::rtl::verify_test
