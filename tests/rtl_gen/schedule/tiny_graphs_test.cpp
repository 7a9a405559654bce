// Tiny graphs, and where the scheduler puts each of their nodes: "name stage ready_ps", or the stages of a
// pipelined component, whose value is latched.
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/schedule.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/schedule/random_schedule.hpp"

namespace hitpipe::rtl::tiny_graphs_test {
namespace {

std::string slots(const Graph& graph, const Schedule& schedule) {
  std::string text;
  for (NodeId id = 0; id < graph.size(); ++id) {
    const Node& n = graph[id];
    const Slot& slot = schedule.slots[id];
    if (n.op == Op::input) continue;
    if (!is_root(n.op)) {
      EXPECT_TRUE(slot.stage == 0 && slot.finish == 0 && slot.ready_ps == 0 && !slot.latched)
          << "wires have no slot";
      continue;
    }
    text += slot.latched ? fmt::format("{} {}-{} latched\n", n.name, slot.stage, slot.finish)
                         : fmt::format("{} {} {}\n", n.name, slot.stage, slot.ready_ps);
    EXPECT_TRUE(slot.latched || slot.finish == slot.stage);
  }
  return text + fmt::format("stages {}, clock {}", schedule.stages, schedule.clock_ps);
}

/// A graph whose nodes are recorded with their names.
struct Tiny {
  Graph g{"tiny"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, true);
  NodeId c = g.input("c", 1, false);

  NodeId named(const char* name, NodeId node) {
    g.annotate(node, name, {});
    return node;
  }
  NodeId make(const char* name, Op op, NodeId x, NodeId y) { return named(name, g.binary(op, x, y, true)); }
  NodeId mux(const char* name, NodeId select, NodeId x, NodeId y) { return named(name, g.mux(select, x, y)); }
  std::string unit(std::optional<int> clock_ps = std::nullopt) {
    return slots(g, schedule_asap(g, unit_library(), clock_ps));
  }
  std::string thesis() { return slots(g, schedule_asap(g, Library::thesis())); }
};

TEST(TinyGraphs, ChainUntilTheStageIsFull) {
  Tiny t;
  const NodeId m = t.mux("m", t.c, t.a, t.b);
  const NodeId n = t.mux("n", t.c, m, t.a);
  const NodeId g = t.make("g", Op::bit_and, n, t.a);
  const NodeId less = t.make("less", Op::less, g, t.b);
  const NodeId late = t.make("late", Op::bit_or, less, t.c);
  const NodeId d = t.make("d", Op::sub, t.a, t.b);  // 10 ps and the latch: the clock
  t.g.output("o", late);
  t.g.output("d", d);
  EXPECT_EQ(t.unit(),
            "m 1 2\n"
            "n 1 4\n"
            "g 1 5\n"
            "less 1 10\n"
            "late 2 1\n"
            "d 1 10\n"
            "stages 2, clock 11");
}

TEST(TinyGraphs, ALateOperandDecidesTheStageAndAnEarlyOneComesOutOfALatch) {
  Tiny t;
  const NodeId d = t.make("d", Op::sub, t.a, t.b);
  const NodeId e = t.make("e", Op::sub, d, t.b);
  const NodeId less = t.make("less", Op::less, t.a, t.b);
  const NodeId m = t.mux("m", less, e, t.a);
  t.g.output("o", t.make("g", Op::bit_xor, m, d));
  EXPECT_EQ(t.unit(),
            "d 1 10\n"
            "e 2 10\n"
            "less 1 5\n"
            "m 3 2\n"
            "g 3 3\n"
            "stages 3, clock 11");
}

TEST(TinyGraphs, TheLaterOfTwoChainedOperandsCounts) {
  Tiny t;
  const NodeId slow = t.make("slow", Op::less, t.a, t.b);
  const NodeId fast = t.make("fast", Op::bit_and, t.c, t.g.slice(t.a, 0, 0));
  t.g.output("o", t.make("both", Op::bit_or, fast, slow));
  t.g.output("p", t.make("other", Op::bit_or, slow, fast));
  EXPECT_EQ(t.unit(11),
            "slow 1 5\n"
            "fast 1 1\n"
            "both 1 6\n"
            "other 1 6\n"
            "stages 1, clock 11");
}

TEST(TinyGraphs, APipelinedComponentFillsItsStagesAndIsLatched) {
  Tiny t;
  const NodeId p = t.make("p", Op::mul, t.a, t.b);
  const NodeId top = t.g.slice(p, 15, 8);
  const NodeId g = t.make("g", Op::bit_and, top, t.a);
  t.g.output("o", t.make("q", Op::mul, g, t.b));
  EXPECT_EQ(t.unit(),
            "p 1-2 latched\n"
            "g 3 1\n"
            "q 4-5 latched\n"
            "stages 5, clock 11");
}

TEST(TinyGraphs, LogicIsChainedBeforeAPipelinedComponentWhenTheClockAllows) {
  Tiny t;
  const NodeId m = t.mux("m", t.c, t.a, t.b);
  const NodeId p = t.make("p", Op::mul, m, t.b);
  t.g.output("o", t.make("g", Op::bit_and, t.g.slice(p, 7, 0), t.b));
  EXPECT_EQ(t.unit(12),
            "m 1 2\n"
            "p 2-3 latched\n"
            "g 4 1\n"
            "stages 4, clock 12");
  EXPECT_EQ(t.unit(13),
            "m 1 2\n"
            "p 1-2 latched\n"
            "g 3 1\n"
            "stages 3, clock 13");
}

TEST(TinyGraphs, ACombinationalMultiplierIsChained) {
  Tiny t;
  const NodeId p = t.make("p", Op::mul, t.g.slice(t.a, 3, 0), t.g.slice(t.b, 3, 0));
  t.g.output("o", t.make("g", Op::bit_xor, p, t.a));
  EXPECT_EQ(t.unit(12),
            "p 1 10\n"
            "g 1 11\n"
            "stages 1, clock 12");
}

TEST(TinyGraphs, WiresTakeNoTime) {
  Tiny t;
  const NodeId d = t.make("d", Op::less, t.a, t.b);
  const NodeId wires = t.g.invert(t.g.extend(t.g.concat(d, t.g.slice(t.a, 6, 3)), 8, true));
  const NodeId e = t.make("e", Op::less, wires, t.g.constant(8, 9));
  t.g.output("o", t.g.invert(e));
  EXPECT_EQ(t.unit(11),
            "d 1 5\n"
            "e 1 10\n"
            "stages 1, clock 11");
}

TEST(TinyGraphs, AStatedStageIsAnEarliestOne) {
  Tiny t;
  t.g.begin_stage(3);
  const NodeId g = t.make("g", Op::bit_and, t.a, t.b);
  t.g.begin_stage(2);
  t.g.output("o", t.make("h", Op::bit_or, g, t.b));
  EXPECT_EQ(t.unit(3),
            "g 3 1\n"
            "h 3 2\n"
            "stages 3, clock 3");
}

TEST(TinyGraphs, APortOrAConstantAsOutputIsOneStage) {
  Tiny t;
  t.g.output("o", t.a);
  t.g.output("one", t.g.constant(3, 1));
  EXPECT_EQ(t.unit(), "stages 1, clock 1");
}

// One axis of figure 7.4 and a comparison after it.
TEST(TinyGraphs, TheThesissFirstStages) {
  Graph g("axis");
  const NodeId origin = g.input("irx", 24, true);
  const NodeId low = g.input("ixmin", 24, true);
  const NodeId high = g.input("ixmax", 24, true);
  const NodeId floor = g.input("iri_floor", 24, true);
  const NodeId ceil = g.input("iri_ceil", 24, true);
  const auto named = [&](const char* name, NodeId node) {
    g.annotate(node, name, {});
    return node;
  };
  const NodeId d0 = named("d0", g.binary(Op::sub, low, origin));
  const NodeId d1 = named("d1", g.binary(Op::sub, high, origin));
  const NodeId d_near = named("d_near", g.mux(g.slice(floor, 23, 23), d1, d0));
  const NodeId ir_near = named("ir_near", g.mux(g.slice(d_near, 23, 23), ceil, floor));
  const NodeId product = named("product", g.binary(Op::mul, d_near, ir_near, true));
  g.output("less", named("less", g.binary(Op::less, g.slice(product, 46, 23), floor, true)));
  EXPECT_EQ(slots(g, schedule_asap(g, Library::thesis())),
            "d0 1 1200\n"
            "d1 1 1200\n"
            "d_near 1 1376\n"
            "ir_near 1 1552\n"
            "product 2-4 latched\n"
            "less 5 477\n"
            "stages 5, clock 3176");
}

TEST(TinyGraphs, TheThesissGatesTake75ps) {
  Tiny t;
  const NodeId less = t.make("less", Op::less, t.a, t.b);
  const NodeId either = t.make("either", Op::bit_or, t.g.invert(less), t.c);
  t.g.output("o", t.make("both", Op::bit_and, either, t.c));
  EXPECT_EQ(t.thesis(),
            "less 1 477\n"
            "either 2 75\n"
            "both 2 150\n"
            "stages 2, clock 653");
}

TEST(Clock, TooShortRejected) {
  Tiny t;
  t.g.output("d", t.make("d", Op::sub, t.a, t.b));
  t.g.output("m", t.mux("m", t.c, t.a, t.b));
  EXPECT_EQ(message_of<std::invalid_argument>([&] { t.unit(10); }),
            "tiny: a clock of 10 ps is too short for int_subtract:8; the smallest that can be met is 11 ps");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { t.unit(11); }), "no exception");
}

TEST(Clock, TooShortForAGateRejected) {
  Tiny t;
  t.g.output("o", t.make("g", Op::bit_xor, t.a, t.b));
  EXPECT_EQ(message_of<std::invalid_argument>([&] { t.unit(1); }),
            "tiny: a clock of 1 ps is too short for xor; the smallest that can be met is 2 ps");
}

TEST(Clock, TooShortForALatchRejected) {
  Tiny t;
  t.g.output("o", t.a);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { t.unit(0); }),
            "tiny: a clock of 0 ps is too short for a latch alone; the smallest that can be met is 1 ps");
}

TEST(Asap, NoLegalScheduleIsEarlier) {
  constexpr int graphs = 300;
  Seeded random(131);
  const Library library = unit_library();
  int later = 0;
  for (int i = 0; i < graphs; ++i) {
    const Graph graph = canonical(Recipe(random, 5, 40, 4).graph());
    const int clock = schedule_asap(graph, library).clock_ps + random.below(20);
    const Schedule asap = schedule_asap(graph, library, clock);
    ASSERT_EQ(verify(graph, library, asap), std::vector<std::string>{});
    const Schedule other = random_schedule(graph, library, clock, random);
    for (NodeId id = 0; id < graph.size(); ++id) {
      ASSERT_LE(asap.slots[id].finish, other.slots[id].finish) << "%" << id << "\n" << to_text(graph);
      later += asap.slots[id].finish < other.slots[id].finish ? 1 : 0;
    }
    ASSERT_LE(asap.stages, other.stages);
  }
  EXPECT_GT(later, graphs) << "the random schedules are as early: they say nothing";
}

TEST(AsStated, OperandsAndStatedStagesDecide) {
  Tiny t;
  t.g.begin_stage(1);
  const NodeId p = t.make("p", Op::sub, t.a, t.b);
  t.g.begin_stage(2);
  const NodeId q = t.make("q", Op::add, p, t.b);
  t.g.begin_stage(1);
  t.g.output("o", t.make("r", Op::add, q, p));
  const Schedule s = schedule_as_stated(t.g, 3);
  EXPECT_EQ(slots(t.g, s), "p 1 0\nq 2 0\nr 2 0\nstages 3, clock 0");
}

TEST(AsStated, StageBeyondTheLastRejected) {
  Tiny t;
  t.g.begin_stage(3);
  t.g.output("o", t.make("p", Op::sub, t.a, t.b));
  EXPECT_EQ(message_of<std::logic_error>([&] { static_cast<void>(schedule_as_stated(t.g, 2)); }),
            "tiny: a node states stage 3 of 2");
}

TEST(AsStated, IsVerified) {
  Tiny t;
  t.g.output("o", t.a);
  EXPECT_EQ(message_of<std::logic_error>([&] { static_cast<void>(schedule_as_stated(t.g, 0)); }),
            "tiny: illegal schedule: 0 stages, at least 1 is needed");
}

}  // namespace
}  // namespace hitpipe::rtl::tiny_graphs_test
