// The Verilog of every machine equals its C++ in every cycle: outputs and registers, with random inputs and
// resets at random times.
#include "sim/machine/verilated_machine.hpp"

#include <gtest/gtest.h>

#include "rtl_gen/emit/machine_files.hpp"
#include "rtl_gen/machine/module.hpp"
#include "tests/rtl_gen/machine/small_queue.hpp"
#include "tests/rtl_gen/text.hpp"

namespace hitpipe::sim::machine_test {
namespace {

constexpr int random_cycles = 1'000'000;

struct Difference {
  int cycle = -1;  ///< -1: none
  std::string what;
};

Difference first_difference(const rtl::MachineGraph& machine, rtl::NativeMachine& native,
                            rtl::NativeMachine& verilog, int count) {
  rtl::RandomCycles cycles(machine, 20051);
  for (int number = 0; number < count; ++number) {
    rtl::MachineCycle expected = cycles.next(), made = expected;
    native.outputs(expected.outputs.data());
    verilog.outputs(made.outputs.data());
    native.step(expected.inputs.data(), expected.reset);
    verilog.step(made.inputs.data(), made.reset);
    native.state(expected.state.data());
    verilog.state(made.state.data());
    // The first cycle resets: before it the Verilog has zeros everywhere.
    for (std::size_t i = 0; i < made.outputs.size() && number > 0; ++i)
      if (made.outputs[i] != expected.outputs[i]) return {number, machine.outputs[i].name};
    for (std::size_t i = 0; i < made.state.size(); ++i)
      if (made.state[i] != expected.state[i]) return {number, machine.state[i].name};
  }
  return {};
}

struct MachineAt {
  const rtl::Machine* machine;
  Format format;

  [[nodiscard]] std::string name() const { return machine->module_at(format); }
};

/// Each in its own format, which is compiled with its widths, and in the smallest numbers, which are not.
std::vector<MachineAt> machines() {
  std::vector<MachineAt> all;
  for (const rtl::Machine& machine : rtl::machines()) {
    all.push_back({&machine, machine.default_format});
    const FormatFamily& family = machine.default_format.family();
    FormatNumbers least = family.usual;
    for (std::size_t i = 0; i < family.fields.size(); ++i)
      if (!family.fields[i].optional) least[i] = family.fields[i].least;
    all.push_back({&machine, {family, least}});
  }
  return all;
}

class EveryMachine : public testing::TestWithParam<MachineAt> {};

TEST_P(EveryMachine, IsTheSameInVerilog) {
  const auto [machine, format] = GetParam();
  VerilatedMachine verilog(*machine, format);
  const Difference found =
      first_difference(machine->graph(format), *machine->native(format), verilog, random_cycles);
  EXPECT_EQ(found.cycle, -1) << found.what;
}

INSTANTIATE_TEST_SUITE_P(Machines, EveryMachine, testing::ValuesIn(machines()),
                         [](const testing::TestParamInfo<MachineAt>& each) { return each.param.name(); });

/// It has a lookup memory.
TEST(VerilatedMachine, QueueIsTheSameInVerilog) {
  const rtl::Machine machine = rtl::small_queue();
  VerilatedMachine verilog(machine, rtl::small_queue_bits);
  const Difference found = first_difference(machine.graph(rtl::small_queue_bits),
                                            *machine.native(rtl::small_queue_bits), verilog, random_cycles);
  EXPECT_EQ(found.cycle, -1) << found.what;
}

/// So a test in which nothing changes says something.
TEST(NativeMachine, MaySpoilWordsThatAreReadWhileTheyAreWritten) {
  const rtl::Machine& machine = *rtl::machine_called("triangle_feed");
  const auto spoilt = machine.native(machine.default_format, rtl::Collision::any_word);
  const Difference found = first_difference(machine.graph(machine.default_format),
                                            *machine.native(machine.default_format), *spoilt, 20'000);
  EXPECT_NE(found.cycle, -1);
}

/// A change of the divider's Verilog, and the register or output that shows it first.
struct Fault {
  const char *good, *bad, *seen;
};

class PlantedFault : public testing::TestWithParam<Fault> {};

TEST_P(PlantedFault, IsSeen) {
  const rtl::Machine& machine = *rtl::machine_called("divider");
  const Format format = machine.default_format;
  const rtl::MachineGraph graph = machine.graph(format);
  const std::string verilog = rtl::to_verilog(graph, {.module = "divider", .bits = "", .shows_state = true});
  VerilatedMachine changed(graph, "divider", rtl::replaced(verilog, GetParam().good, GetParam().bad));
  const Difference found = first_difference(graph, *machine.native(format), changed, 20'000);
  EXPECT_EQ(found.what, GetParam().seen);
}

INSTANTIATE_TEST_SUITE_P(Divider, PlantedFault,
                         testing::Values(Fault{"dets[next_oldest_value]", "dets[oldest]", "thrice"},
                                         Fault{"used <= 6'h0", "used <= 6'h1", "used"},
                                         Fault{"answers <= compares", "answers <= last", "answers"}));

}  // namespace
}  // namespace hitpipe::sim::machine_test
