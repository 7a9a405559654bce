// What verify() says of machines that break a rule, and how a machine runs in software.
#include "rtl_gen/machine/machine.hpp"

#include <deque>
#include <functional>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rtl_gen/machine/small_queue.hpp"

namespace hitpipe::rtl::machine_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(VerifyMachine, EveryMachineKeepsTheRules) {
  for (const Machine& machine : machines())
    EXPECT_THAT(verify(machine.graph_at(machine.default_format)), IsEmpty()) << machine.name;
  EXPECT_THAT(verify(small_queue().graph(small_queue_bits)), IsEmpty());
}

struct Broken {
  const char* name;
  std::function<void(MachineGraph&)> change;
  const char* said;
};

class VerifyBroken : public testing::TestWithParam<Broken> {};

TEST_P(VerifyBroken, SaysWhatIsWrong) {
  MachineGraph machine = small_queue().graph(small_queue_bits);
  GetParam().change(machine);
  EXPECT_THAT(verify(machine), testing::Contains(HasSubstr(GetParam().said)));
}

NodeId input_called(const Graph& graph, std::string_view name) {
  for (const NodeId id : graph.inputs())
    if (graph[id].name == name) return id;
  return no_node;
}

INSTANTIATE_TEST_SUITE_P(
    Rules, VerifyBroken,
    testing::Values(
        Broken{"NameTwice", [](MachineGraph& m) { m.outputs[0].name = "push"; }, "push: the name is taken"},
        Broken{"Keyword", [](MachineGraph& m) { m.inputs[0].name = "wire"; }, "wire"},
        Broken{"MacroOfSome", [](MachineGraph& m) { m.inputs[0].name = "far"; }, "far: Verilator"},
        Broken{"WidePort", [](MachineGraph& m) { m.inputs[2].width = 65; },
               "ray has 65 bits; allowed are 1 to 64"},
        Broken{"OtherWidth", [](MachineGraph& m) { m.state[0].width = 5; },
               "next_used has 4 bits; allowed are 5"},
        Broken{"NotGiven",
               [](MachineGraph& m) {
                 m.outputs.push_back(hls::Field{"more", 1});
               },
               "the step gives more 0 times"},
        Broken{"NotTaken", [](MachineGraph& m) { m.graph.output("more", m.graph.constant(1, 0)); },
               "output more of the graph: nothing takes it"},
        Broken{"WordsOfAMemory", [](MachineGraph& m) { m.memories[0].words = 6; },
               "rays has 6 words; allowed are powers of two from 2 on"},
        Broken{"PathThrough",
               [](MachineGraph& m) {
                 m.outputs.push_back(hls::Field{"echo", 1});
                 m.graph.output("echo", input_called(m.graph, "pop"));
               },
               "output echo depends on input pop, so a path leads through the machine"},
        Broken{"WordSaysWhichWord",
               [](MachineGraph& m) {
                 m.memories.push_back({"more", 8, 3, hls::MemoryKind::lookup});
                 const NodeId word = m.graph.input("more_word", 3, false);
                 for (const char* what : {"more_read", "more_place", "more_written"})
                   m.graph.output(what, word);
                 m.graph.output("more_writes", m.graph.constant(1, 0));
               },
               "more_read depends on more_word"}),
    [](const testing::TestParamInfo<Broken>& each) { return each.param.name; });

TEST(Machine, RefusesAFormat) {
  const Machine machine = small_queue();
  EXPECT_EQ(to_string(machine.parse_format("20+1s20i5")), "20+1s20i5");
  EXPECT_THROW((void)machine.parse_format("20+1s20i9"), std::runtime_error);
  EXPECT_THROW((void)machine.graph(hls::WorldBits{}), std::runtime_error);
  EXPECT_THROW((void)machine.native(hls::CoreBits{{20, 1, 20, 0, 0}, 0}), std::runtime_error);
}

/// In a format that is compiled with its widths, and in one whose widths are values.
TEST(NativeMachine, IsAQueue) {
  for (const hls::CoreBits& bits : {small_queue_bits, hls::CoreBits{{8, 0, 8, 0, 0}, 2}}) {
    const auto machine = small_queue().native(bits);
    std::mt19937 random(3);
    std::deque<Word> expected;
    Word out[2];
    const Word nothing[3] = {};
    machine->outputs(out);
    machine->step(nothing, true);
    for (int cycle = 0; cycle < 20'000; ++cycle) {
      const bool room = static_cast<int>(expected.size()) < bits.rays();
      const Word in[3] = {room && random() % 2 == 0, random() % 2, random() & ones_below(bits.ray)};
      machine->outputs(out);
      machine->step(in, false);
      ASSERT_EQ(out[0] != 0, !expected.empty()) << "cycle " << cycle;
      if (!expected.empty()) {
        ASSERT_TRUE(out[1] == expected.front()) << "cycle " << cycle;
        if (in[1] != 0) expected.pop_front();
      }
      if (in[0] != 0) expected.push_back(in[2]);
    }
  }
}

TEST(NativeMachine, AResetSetsWhatSaysAValue) {
  const auto machine = small_queue().native(small_queue_bits);
  const Word push[3] = {1, 0, 5};
  Word out[2], state[2];
  machine->outputs(out);
  machine->step(push, false);
  machine->state(state);
  EXPECT_THAT(std::vector<int>({static_cast<int>(state[0]), static_cast<int>(state[1])}), ElementsAre(1, 1));
  machine->outputs(out);
  machine->step(push, true);
  machine->state(state);
  EXPECT_THAT(std::vector<int>({static_cast<int>(state[0]), static_cast<int>(state[1])}), ElementsAre(0, 1));
}

}  // namespace
}  // namespace hitpipe::rtl::machine_test
