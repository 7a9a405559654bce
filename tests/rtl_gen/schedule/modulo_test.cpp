// Modulo schedules: the rules of sharing one by one, tiny graphs with their stages, every design at II = 1,
// and random graphs.
#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "rtl_gen/schedule/sharing.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"

namespace hitpipe::rtl::modulo_test {
namespace {

using Broken = std::vector<std::string>;

void expect_same_slots(const Schedule& a, const Schedule& b) {
  EXPECT_EQ(a.stages, b.stages);
  EXPECT_EQ(a.clock_ps, b.clock_ps);
  ASSERT_EQ(a.slots.size(), b.slots.size());
  for (std::size_t i = 0; i < a.slots.size(); ++i) {
    EXPECT_EQ(a.slots[i].stage, b.slots[i].stage) << i;
    EXPECT_EQ(a.slots[i].finish, b.slots[i].finish) << i;
    EXPECT_EQ(a.slots[i].ready_ps, b.slots[i].ready_ps) << i;
    EXPECT_EQ(a.slots[i].latched, b.slots[i].latched) << i;
  }
}

/// Three products of 8 bits (2 stages each), of operands that are there at once.
struct ThreeProducts {
  Library library = unit_library();
  Graph g{"three"};
  NodeId a = g.input("a", 8, true);
  NodeId b = g.input("b", 8, true);
  NodeId c = g.input("c", 8, true);
  NodeId ab = named("ab", g.binary(Op::mul, a, b, true));
  NodeId ac = named("ac", g.binary(Op::mul, a, c, true));
  NodeId bc = named("bc", g.binary(Op::mul, b, c, true));

  ThreeProducts() {
    g.output("o", ab);
    g.output("p", ac);
    g.output("q", bc);
  }
  NodeId named(const char* name, NodeId node) {
    g.annotate(node, name, {});
    return node;
  }
  [[nodiscard]] SharingProblem problem(int interval, int instances) const {
    return {.graph = g, .library = library, .interval = interval, .groups = {{{ab, ac, bc}, instances}}};
  }
  [[nodiscard]] Broken broken(const SharedSchedule& s) const {
    return verify(g, library, s.schedule, s.binding);
  }
};

TEST(Modulo, ThreeProductsOnOneInstanceStartOneAfterTheOther) {
  const ThreeProducts t;
  const SharedSchedule s = schedule_modulo(t.problem(3, 1));
  EXPECT_EQ(s.binding.instance_of, (std::map<NodeId, int>{{t.ab, 0}, {t.ac, 0}, {t.bc, 0}}));
  EXPECT_EQ(s.schedule.slots[t.ab].stage, 1);
  EXPECT_EQ(s.schedule.slots[t.ac].stage, 2);
  EXPECT_EQ(s.schedule.slots[t.bc].stage, 3);
  EXPECT_EQ(s.schedule.slots[t.bc].finish, 5) << "selection in stage 3, then two stages of the product";
  EXPECT_EQ(s.schedule.stages, 5);
}

TEST(Modulo, TwoInstancesShareTheProducts) {
  const ThreeProducts t;
  const SharedSchedule s = schedule_modulo(t.problem(2, 2));
  EXPECT_EQ(s.binding.instance_of, (std::map<NodeId, int>{{t.ab, 0}, {t.ac, 1}, {t.bc, 1}}))
      << "ac and bc have the same second operand";
  EXPECT_EQ(s.schedule.slots[t.ab].stage, 1);
  EXPECT_EQ(s.schedule.slots[t.ac].stage, 1);
  EXPECT_EQ(s.schedule.slots[t.bc].stage, 2);
}

TEST(Modulo, ASelectionNeedsOneInputForEachRegisterThatIsRead) {
  const ThreeProducts t;
  const SharedSchedule s = schedule_modulo(t.problem(3, 1));
  const auto values = [&](int interval, std::size_t place) {
    const Binding binding{interval, s.binding.instance_of};
    const Placement placement = place_registers(t.g, s.schedule, Ports::latched, binding);
    return selected_values(t.g, {s.schedule, binding}, RegisterTable(placement, interval), {t.ab, t.ac, t.bc},
                           place);
  };
  EXPECT_EQ(values(3, 0), 2) << "a, a, b";
  EXPECT_EQ(values(3, 1), 2) << "b, c, c";
  EXPECT_EQ(values(1, 0), 3) << "a in the stage after it is in another register";
  EXPECT_EQ(values(2, 1), 3) << "c in stage 3 too";
}

TEST(Modulo, ASelectionThatDoesNotFitBehindLogicWaits) {
  const Library library = unit_library();
  Graph g("waits");
  const NodeId a = g.input("a", 8, true);
  const NodeId d = g.binary(Op::sub, a, g.input("b", 8, true));  // 10 of 11 ps
  const NodeId first = g.binary(Op::mul, d, a, true);
  const NodeId second = g.binary(Op::mul, a, a, true);
  g.output("o", first);
  g.output("p", second);
  const SharedSchedule s =
      schedule_modulo({.graph = g, .library = library, .interval = 2, .groups = {{{first, second}, 1}}});
  EXPECT_EQ(s.schedule.slots[second].stage, 1);
  EXPECT_EQ(s.schedule.slots[first].stage, 2) << "10 ps and a multiplexer of 2 ps exceed 11 ps";
}

TEST(Modulo, VerifyFindsTwoOperationsInOnePhase) {
  const ThreeProducts t;
  SharedSchedule s = schedule_modulo(t.problem(3, 1));
  ASSERT_EQ(t.broken(s), Broken{});
  s.binding.interval = 2;
  EXPECT_EQ(t.broken(s), Broken{"ab and bc start in stages 1 and 3 on instance 0, the same modulo 2"});
}

TEST(Modulo, VerifyFindsTwoOperationsInOneStage) {
  const ThreeProducts t;
  SharedSchedule s = schedule_modulo(t.problem(2, 2));
  s.binding.instance_of[t.ac] = 0;
  EXPECT_EQ(t.broken(s), Broken{"ab and ac start in stages 1 and 1 on instance 0, the same modulo 2"});
}

TEST(Modulo, VerifyFindsTwoKinds) {
  ThreeProducts t;
  const NodeId other = t.named("other", t.g.binary(Op::mul, t.a, t.b, false));
  t.g.output("r", other);
  SharedSchedule s = schedule_modulo(t.problem(4, 1));
  s.binding.instance_of[other] = 0;
  s.schedule.slots[other] = {.stage = 4, .finish = 6, .ready_ps = 0, .latched = true};
  s.schedule.stages = 6;
  EXPECT_EQ(t.broken(s), Broken{"ab and other share instance 0 but are of different kinds"});
}

TEST(Modulo, VerifyFindsAMissingSelection) {
  const ThreeProducts t;
  SharedSchedule s = schedule_modulo(t.problem(3, 1));
  --s.schedule.slots[t.bc].finish;
  EXPECT_EQ(t.broken(s), Broken{"bc has 2 internal stages and a selection but occupies stages 3 to 4"});
}

TEST(Modulo, VerifyFindsASelectionThatIsTooSlow) {
  const Library library = unit_library();
  Graph g("slow");
  const NodeId a = g.input("a", 8, true);
  const NodeId b = g.input("b", 8, true);
  const NodeId p = g.binary(Op::mul, g.binary(Op::sub, a, b), a, true);
  g.annotate(p, "p", {});
  const NodeId q = g.binary(Op::mul, a, b, true);
  g.output("o", p);
  g.output("q", q);
  Schedule s = schedule_asap(g, library);
  const Binding binding{.interval = 2, .instance_of = {{p, 0}, {q, 0}}};
  s.slots[p] = {.stage = 1, .finish = 3, .ready_ps = 0, .latched = true};
  s.slots[q] = {.stage = 2, .finish = 4, .ready_ps = 0, .latched = true};
  s.stages = 4;
  EXPECT_EQ(
      verify(g, library, s, binding),
      Broken{"p: 12 ps of logic before its latched operands and a 1 ps latch exceed the clock of 11 ps"});
}

TEST(Modulo, WrongProblemsRejected) {
  const ThreeProducts t;
  const auto message = [&](const SharingProblem& problem) {
    return message_of<std::invalid_argument>([&] { (void)schedule_modulo(problem); });
  };
  EXPECT_EQ(message(t.problem(0, 3)), "three: interval 0: allowed is 1 to 64");
  EXPECT_EQ(message(t.problem(65, 1)), "three: interval 65: allowed is 1 to 64");
  EXPECT_EQ(message(t.problem(2, 1)), "three: 3 operations on 1 instances: in 2 cycles they carry out 2");
  EXPECT_EQ(message(t.problem(2, 0)), "three: 3 operations on 0 instances: in 2 cycles they carry out 0");
  SharingProblem twice = t.problem(4, 1);
  twice.groups.push_back({{t.ab}, 1});
  EXPECT_EQ(message(twice), "three: operation %3 is in two groups");
  SharingProblem kinds = t.problem(4, 1);
  kinds.groups.front().operations.push_back(t.a);
  EXPECT_EQ(message(kinds), "three: operation %0 is not of the kind of its group");
  Graph many("many");
  SharingGroup group;
  for (int i = 0; i < 33; ++i) {
    const std::string number = std::to_string(i);
    const NodeId a = many.input("a" + number, 8, true);
    group.operations.push_back(many.binary(Op::mul, a, many.input("b" + number, 8, true), true));
    many.output("o" + number, group.operations.back());
  }
  EXPECT_EQ(message({.graph = many, .library = t.library, .interval = 64, .groups = {group}}),
            "many: a clock of 11 ps is too short to select among 33 operands; the smallest that can be met "
            "is 13 ps");
}

TEST(Modulo, KindsHaveOneOperationOneSignAndOneWidth) {
  ThreeProducts t;
  t.g.output("r", t.g.binary(Op::mul, t.a, t.b, false));
  t.g.output("s", t.g.binary(Op::mul, t.g.slice(t.a, 6, 0), t.b, true));
  t.g.output("t", t.g.binary(Op::sub, t.a, t.b));
  t.g.output("u", t.g.binary(Op::sub, t.b, t.a));
  const std::vector<SharingGroup> kinds = kinds_of(t.g);
  ASSERT_EQ(kinds.size(), 2);
  EXPECT_EQ(kinds[0].operations.size(), 2) << "the subtractions";
  EXPECT_EQ(kinds[1].operations, (std::vector<NodeId>{t.ab, t.ac, t.bc}));
}

class ModuloOfDesign : public testing::TestWithParam<DesignFormat> {};

TEST_P(ModuloOfDesign, WithoutGroupsIsTheScheduleAsSoonAsPossible) {
  const Pipeline p = GetParam().pipeline();
  for (const int interval : {1, 3}) {
    const SharedSchedule s =
        schedule_modulo({.graph = p.graph, .library = Library::thesis(), .interval = interval});
    EXPECT_TRUE(s.binding.instance_of.empty());
    expect_same_slots(s.schedule, p.schedule);
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, ModuloOfDesign, testing::ValuesIn(every_design({"16/16", "6/6"})),
                         design_suffix);

TEST(Modulo, RandomGraphsOnTheFewestInstancesAreLegal) {
  const Library library = unit_library();
  int shared = 0;
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    Seeded random(seed);
    const Graph g = canonical(Recipe(random, 5, 80, 3).graph());
    for (const int interval : {2, 3, 5}) {
      std::vector<SharingGroup> groups = kinds_of(g);
      for (SharingGroup& group : groups)
        group.instances = (static_cast<int>(group.operations.size()) + interval - 1) / interval;
      // schedule_modulo() throws std::logic_error if verify() finds a broken rule.
      const SharedSchedule s = schedule_modulo(
          {.graph = g, .library = library, .interval = interval, .groups = groups, .clock_ps = 40});
      for (const SharingGroup& group : groups)
        for (const NodeId id : group.operations) shared += s.binding.instance_of.contains(id) ? 1 : 0;
      EXPECT_EQ(verify(g, library, s.schedule, s.binding), Broken{}) << seed;
    }
  }
  EXPECT_GT(shared, 1000);
}

}  // namespace
}  // namespace hitpipe::rtl::modulo_test
