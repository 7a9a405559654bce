// Registers that load the same bits again need no enable.
#include <algorithm>
#include <optional>
#include <set>

#include <gtest/gtest.h>

#include "rtl_gen/graph/canonical.hpp"
#include "rtl_gen/graph/sources.hpp"
#include "rtl_gen/schedule/registers.hpp"
#include "tests/rtl_gen/component/unit_library.hpp"
#include "tests/rtl_gen/graph/recipe.hpp"
#include "tests/rtl_gen/schedule/random_schedule.hpp"

namespace hitpipe::rtl::enables_test {
namespace {

/// Which test's value each register has, cycle by cycle. Test k is in stage s in cycle k * interval + s.
class Cycles {
 public:
  Cycles(const Graph& graph, const SharedSchedule& shared, const Placement& placement)
      : graph_(graph),
        schedule_(shared.schedule),
        binding_(shared.binding),
        placement_(placement),
        table_(placement, shared.binding.interval),
        held_(placement.registers.size()) {}

  /// Whether every stage reads the bits of the test that works in it.
  bool all_reads_are_right(int tests) {
    for (int cycle = 0; cycle <= tests * interval() + schedule_.stages; ++cycle) {
      for (int test = 0; test < tests; ++test)
        if (!reads_are_right(test, cycle - test * interval(), cycle)) return false;
      load(cycle);
    }
    return true;
  }

 private:
  using Test = std::optional<int>;  ///< nothing: no test's
  /// Whose bits they are. A constant's are nobody's.
  struct Held {
    NodeId value = no_node;
    std::set<Test> tests{std::nullopt};
  };

  [[nodiscard]] int interval() const { return binding_.interval; }

  /// The test that works in a stage; nothing where none does.
  [[nodiscard]] Test test_in(int stage, int cycle) const {
    const int since = cycle - stage;
    return since >= 0 && since % interval() == 0 ? Test(since / interval()) : std::nullopt;
  }

  /// Adds the tests whose bits a stage reads.
  void add_read(std::set<Test>& tests, NodeId value, Word bits, int stage, int cycle) const {
    for_each_run(bits, [&](int high, int low) {
      const auto found = table_.find(value, high, low, stage);
      if (!found)
        add_made(tests, value, cycle);
      else if (held_[*found].value == value)
        tests.insert(held_[*found].tests.begin(), held_[*found].tests.end());
      else
        tests.insert(std::nullopt);
    });
  }

  /// Adds the tests whose bits come out of a port, a component or a gate.
  void add_made(std::set<Test>& tests, NodeId value, int cycle) const {
    const Slot& slot = schedule_.slots[value];
    if (graph_[value].op == Op::input || binding_.shares(value) || slot.latched) {
      tests.insert(test_in(slot.finish, cycle));
      return;
    }
    for_each_source(graph_, value,
                    [&](NodeId source, Word bits) { add_read(tests, source, bits, slot.stage, cycle); });
  }

  [[nodiscard]] bool reads_are_right(int test, int stage, int cycle) const {
    if (stage < 1) return true;
    std::set<Test> tests{test};
    const auto add = [&](NodeId source, Word bits) { add_read(tests, source, bits, stage, cycle); };
    for (NodeId id = 0; id < graph_.size(); ++id) {
      const bool works = is_root(graph_[id].op) && graph_[id].op != Op::input;
      if (works && schedule_.slots[id].stage == stage) for_each_source(graph_, id, add);
    }
    if (stage == schedule_.stages + 1)
      for (const Output& out : graph_.outputs()) for_each_source_of(graph_, out.node, add);
    return tests.size() == 1;
  }

  void load(int cycle) {
    std::vector<Held> next = held_;
    for (std::size_t i = 0; i < next.size(); ++i) {
      const Register& r = placement_.registers[i];
      const bool in_every_cycle = !r.holds() || r.loads_again;
      if (in_every_cycle) next[i] = {};
      for (const Passing& p : r.values()) {
        const bool in_phase = cycle % interval() == p.boundary % interval();
        if (!in_phase && !(in_every_cycle && r.others.empty())) continue;
        next[i] = {p.value, {}};
        add_read(next[i].tests, p.value, bit_range(r.high, r.low) & width_of(p.value), p.boundary, cycle);
      }
    }
    held_ = std::move(next);
  }

  [[nodiscard]] Word width_of(NodeId value) const { return bit_range(graph_[value].width - 1, 0); }

  const Graph& graph_;
  const Schedule& schedule_;
  const Binding& binding_;
  const Placement& placement_;
  RegisterTable table_;
  std::vector<Held> held_;
};

/// A gate in stage 1, whose result is read in stage 3. Its operands are read in stage `operands_until` too.
Placement of_a_gate(int interval, int operands_until) {
  Graph g("gate");
  const NodeId a = g.input("a", 8, false);
  const NodeId b = g.input("b", 8, false);
  g.begin_stage(1);
  const NodeId early = g.binary(Op::bit_and, a, b);
  g.begin_stage(operands_until);
  const NodeId operands = g.binary(Op::bit_or, a, b);
  g.begin_stage(3);
  g.output("late", g.binary(Op::bit_xor, early, operands));
  const Schedule schedule = schedule_asap(g, unit_library());
  Placement placement = place_registers(g, schedule, Ports::latched, {interval, {}});
  drop_needless_enables(placement, g, schedule, {interval, {}});
  std::erase_if(placement.registers, [&](const Register& r) { return r.value != early; });
  return placement;
}

TEST(Enables, AResultWhoseOperandsStayLoadsAgain) {
  const Placement placement = of_a_gate(4, 2);
  ASSERT_EQ(placement.registers.size(), 1U);
  EXPECT_TRUE(placement.registers[0].holds());
  EXPECT_TRUE(placement.registers[0].loads_again);
}

TEST(Enables, AResultWhoseOperandsLeaveKeepsItsEnable) {
  const Placement placement = of_a_gate(4, 1);
  ASSERT_EQ(placement.registers.size(), 1U);
  EXPECT_TRUE(placement.registers[0].holds());
  EXPECT_FALSE(placement.registers[0].loads_again);
}

TEST(Enables, NoReadOfARandomUnitGetsAnotherTestsBits) {
  constexpr int graphs = 300;
  Seeded random(157);
  const Library library = unit_library();
  int dropped = 0;
  for (int i = 0; i < graphs; ++i) {
    const Graph graph = canonical(Recipe(random, 5, 40, 4).graph());
    const int clock_ps = schedule_asap(graph, library).clock_ps;
    SharedSchedule shared{random_schedule(graph, library, clock_ps, random), {2 + i % 5, {}}};
    if (i % 2 == 1) {
      SharingProblem problem{.graph = graph, .library = library, .interval = 2 + i % 5};
      problem.groups = kinds_of(graph);
      for (SharingGroup& group : problem.groups)
        group.instances = 1 + static_cast<int>(group.operations.size()) / 2;
      problem.clock_ps = 2 * clock_ps;
      shared = schedule_modulo(problem);
    }
    Placement placement = place_registers(graph, shared.schedule, Ports::latched, shared.binding);
    ASSERT_TRUE(Cycles(graph, shared, placement).all_reads_are_right(4)) << "before";
    drop_needless_enables(placement, graph, shared.schedule, shared.binding);
    ASSERT_TRUE(Cycles(graph, shared, placement).all_reads_are_right(4)) << to_text(graph);
    dropped += static_cast<int>(std::count_if(placement.registers.begin(), placement.registers.end(),
                                              [](const Register& r) { return r.loads_again; }));
  }
  EXPECT_GT(dropped, graphs / 2) << dropped;
}

}  // namespace
}  // namespace hitpipe::rtl::enables_test
