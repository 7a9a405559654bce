#include "rtl_gen/emit/machine_files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/fusesoc.hpp"
#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/machine/cycle_bench.hpp"
#include "rtl_gen/machine/picture.hpp"
#include "rtl_gen/part/part.hpp"

namespace hitpipe::rtl {

namespace {

/// The machine in random cycles, with its C++.
CycleTest cycle_test(const MachineGraph& graph, NativeMachine& native, const std::string& module,
                     const MachineFilesOptions& options) {
  CycleTest test{.module = module, .inputs = {}, .outputs = {}, .registers = {}, .cycles = {}};
  for (const hls::Field& field : graph.inputs) test.inputs.push_back({field.name, field.width});
  for (const hls::Field& field : graph.outputs) test.outputs.push_back({field.name, field.width});
  test.begins_with = "    // The C++ begins with the values of a reset, and zeros elsewhere.\n";
  for (const hls::Field& field : graph.state) {
    test.registers.push_back({field.name, field.width});
    test.begins_with += fmt::format("    dut.{} = {};\n", field.name, field.reset);
  }
  for (const hls::MemoryShape& memory : graph.memories) {
    if (memory.is_written())
      test.begins_with +=
          fmt::format("    for (i = 0; i < {0}; i = i + 1) dut.{1}[i] = 0;\n", memory.words, memory.name);
    if (memory.is_late()) test.begins_with += fmt::format("    dut.{}_word = 0;\n", memory.name);
  }
  RandomCycles cycles(graph, options.seed);
  for (int i = 0; i < options.cycles; ++i) {
    MachineCycle& cycle = test.cycles.emplace_back(cycles.next());
    native.outputs(cycle.outputs.data());
    native.step(cycle.inputs.data(), cycle.reset);
    native.state(cycle.state.data());
  }
  return test;
}

std::string core_file(const Part& part, const Library& library) {
  const std::string& module = part.interface.module;
  FuseSoc core{.name = "machine:" + module,
               .description = fmt::format("{} at {}", part.machine->summary, to_string(part.format))};
  core.add_verilog("rtl", module);
  core.add_test("tb", {{"tb/" + module + "_tb.sv", "systemVerilogSource"}}, module + "_vectors.hex");
  core.targets.push_back({"default", "Verilog of the machine", {"rtl"}, module});
  core.add_lint({"rtl"}, module);
  core.add_simulations({"rtl"}, module + "_tb");
  core.add_synthesis(library, {"rtl"}, module);
  return core.text();
}

}  // namespace

RandomCycles::RandomCycles(const MachineGraph& machine, std::uint64_t seed) : random_(seed) {
  for (const hls::Field& field : machine.inputs) widths_.push_back(field.width);
  cycle_.inputs.resize(widths_.size());
  cycle_.outputs.resize(machine.outputs.size());
  cycle_.state.resize(machine.state.size());
}

const MachineCycle& RandomCycles::next() {
  cycle_.reset = first_ || random_() % 1000 == 0;
  first_ = false;
  for (std::size_t i = 0; i < widths_.size(); ++i) {
    const Word word = Word{random_()} << 64 | random_();
    const auto values = static_cast<std::uint64_t>(widths_[i]) + 1;
    cycle_.inputs[i] =
        word & ones_below(random_() % 4 == 0 ? static_cast<int>(random_() % values) : widths_[i]);
  }
  return cycle_;
}

std::vector<host::File> machine_files(const Machine& machine, const Format& format, const Library& library,
                                      const MachineFilesOptions& options) {
  const std::string module = options.module.empty() ? machine.module_at(format) : options.module;
  const Part part = machine_part(machine, format, module);
  const CycleTest test = cycle_test(*part.graph, *machine.native(format), module, options);
  return with_licence(std::vector<host::File>{
      {module + ".v", to_verilog(part, library)},
      {module + ".json", manifest(part, library).dump(2) + "\n"},
      {module + ".core", core_file(part, library)},
      {module + ".dot", to_dot(*part.graph, fmt::format("{} {}", machine.name, to_string(format)))},
      {"tb/" + module + "_tb.sv", testbench_text(test)},
      {"tb/" + module + "_vectors.hex", vectors_text(test)},
      {"tb/Makefile", testbench_makefile()}});
}

}  // namespace hitpipe::rtl
