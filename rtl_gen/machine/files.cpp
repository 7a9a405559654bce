#include "rtl_gen/machine/files.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/machine/cycle_test.hpp"
#include "rtl_gen/machine/module.hpp"
#include "rtl_gen/machine/picture.hpp"

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

Json fields_json(const std::vector<hls::Field>& fields) {
  Json list = Json::array();
  for (const hls::Field& field : fields) {
    list.push_back({{"name", field.name}, {"width", field.width}, {"signed", field.is_signed}});
    if (field.has_reset) list.back()["reset"] = field.reset;
  }
  return list;
}

Json machine_manifest(const MachineGraph& graph, const Machine& machine, const Format& format,
                      const Library& library, const std::string& module) {
  Json memories = Json::array();
  for (const hls::MemoryShape& memory : graph.memories)
    memories.push_back({{"name", memory.name},
                        {"words", memory.words},
                        {"width", memory.width},
                        {"kind", memory.kind_name()}});
  const MachinePath path = longest_path(graph, library);
  return {{"machine", machine.name},
          {"bits", to_string(format)},
          {"module", module},
          {"license", output_licence},
          {"library", library.name()},
          {"clock_ps", path.clock_ps},
          {"longest_path", path.names},
          {"inputs", fields_json(graph.inputs)},
          {"outputs", fields_json(graph.outputs)},
          {"registers", fields_json(graph.state)},
          {"memories", memories}};
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
  const MachineGraph graph = machine.graph(format);
  const std::string module = options.module.empty() ? machine.module_at(format) : options.module;
  const CycleTest test = cycle_test(graph, *machine.native(format), module, options);
  return with_licence(std::vector<host::File>{
      {module + ".v", to_verilog(graph, {.module = module, .bits = to_string(format)})},
      {module + ".json", machine_manifest(graph, machine, format, library, module).dump(2) + "\n"},
      {module + ".dot", to_dot(graph, fmt::format("{} {}", machine.name, to_string(format)))},
      {"tb/" + module + "_tb.sv", testbench_text(test)},
      {"tb/" + module + "_vectors.hex", vectors_text(test)},
      {"tb/Makefile", testbench_makefile()}});
}

}  // namespace hitpipe::rtl
