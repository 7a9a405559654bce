#include "rtl_gen/core/files.hpp"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/core/axi.hpp"
#include "rtl_gen/core/c_header.hpp"
#include "rtl_gen/core/feature.hpp"
#include "rtl_gen/core/picture.hpp"
#include "rtl_gen/core/registers.hpp"
#include "rtl_gen/core/system_rdl.hpp"
#include "rtl_gen/emit/fusesoc.hpp"
#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/testbench.hpp"

namespace hitpipe::rtl {

namespace {

/// Outputs of a channel mean nothing without its valid bit.
std::string meaning_of(const Core& core, const CorePort& output) {
  if (!output.meaning.empty()) return output.meaning;
  const std::string valid = output.pin.name.substr(0, output.pin.name.find('_')) + "_valid";
  const bool has = std::ranges::any_of(
      core.ports, [&](const CorePort& port) { return !port.pin.is_input && port.pin.name == valid; });
  return has && output.pin.name != valid ? "want_" + valid : "";
}

CycleTest test_of(const Core& core, std::vector<MachineCycle> cycles) {
  CycleTest test{
      .module = core.module, .inputs = {}, .outputs = {}, .registers = {}, .cycles = std::move(cycles)};
  test.begins_with =
      "    // Before the first reset the registers are unknown.\n"
      "    rst = 1'b1;\n    #5 clk = 1'b1;\n    #5 clk = 1'b0;\n";
  for (const CorePort& port : core.ports) {
    if (port.pin.is_input)
      test.inputs.push_back({port.pin.name, port.pin.width});
    else
      test.outputs.push_back({port.pin.name, port.pin.width, meaning_of(core, port)});
  }
  return test;
}

Json part_json(const Part& part) {
  Json json{{"name", part.name}};
  if (part.machine != nullptr)
    json["machine"] = part.machine->name;
  else
    json["design"] = part.design->name;
  json["bits"] = to_string(part.format);
  json["module"] = part.interface.module;
  if (part.pipeline) {
    json["latency"] = part.pipeline->latency();
    json["ii"] = part.pipeline->interval();
    return json;
  }
  json["memories"] = memories_json(*part.graph);
  return json;
}

Json manifest_of(const Core& core, const Library& library) {
  const CoreOptions& options = core.options;
  Json parts = Json::array();
  for (const Part& part : core.parts) parts.push_back(part_json(part));
  Json wires = Json::array();
  for (const CoreWire& wire : core.wires) {
    const auto end = [&](std::size_t part, std::size_t pin) {
      return fmt::format("{}.{}", core.parts[part].name, core.parts[part].interface.pins[pin].name);
    };
    wires.push_back({end(wire.from, wire.output), end(wire.to, wire.input)});
  }
  Json json = module_json(options.bits, core.interface());
  json.update(options_json(options));
  json.update({{"library", library.name()},
               {"clock_ps", core.clock_ps},
               {"axi", axi_json(core)},
               {"registers", registers_json(core_registers(options))},
               {"ports", ports_json(core.interface())},
               {"parts", parts},
               {"wires", wires}});
  return json;
}

std::vector<FuseSoc::File> harness_sources(const Core& core) {
  std::vector<FuseSoc::File> sources;
  for (const host::File& file : system_program(core))
    sources.push_back({file.name, "cppSource", file.name.ends_with(".hpp")});
  return sources;
}

std::string fusesoc_text(const Core& core, const Library& library) {
  const std::string& module = core.module;
  const std::string axi = axi_module(core);
  FuseSoc file{.name = "core:" + module,
               .description = fmt::format("Ray-tracing core at {}, {} rays in flight",
                                          to_string(Format(core.options.bits)), core.options.rays)};
  file.add_verilog("rtl", module);
  file.add_verilog("axi", axi);
  file.filesets.push_back(
      {"header",
       fmt::format("    files: [{}.h: {{is_include_file: true}}]\n    file_type: cSource\n", module)});
  file.filesets.push_back({"registers", fmt::format("    files: [{}.rdl]\n    file_type: user\n", module)});
  file.add_test("tb", {{"tb/" + module + "_tb.sv", "systemVerilogSource"}}, module + "_vectors.hex");
  file.add_test("harness", harness_sources(core), module + "_scene.txt");
  file.targets.push_back(
      {"default", "Verilog, C header and registers of the core", {"rtl", "axi", "header", "registers"}, axi});
  file.add_lint({"rtl", "axi"}, axi);
  file.add_simulations({"rtl"}, module + "_tb");
  file.add_harness({"rtl", "axi", "header", "harness"}, axi);
  file.add_synthesis(library, {"rtl", "axi"}, axi);
  return file.text();
}

/// A unit's module is in the file of the core.
void add_unit_test(std::vector<host::File>& files, const Part& part, const VectorSet& vectors) {
  const ModuleInterface unit = unit_part(*part.design, part.format, part.interface.module, *part.pipeline,
                                         part.interface.flow_control())
                                   .interface;
  const std::vector<hls::Result> results = part.design->results(part.format);
  files.push_back({fmt::format("tb/{}_tb.sv", unit.module),
                   testbench(unit, static_cast<int>(vectors.size()), part.pipeline->latency())});
  files.push_back({fmt::format("tb/{}_vectors.hex", unit.module),
                   vector_summary(part.design->name_at(part.format), vectors, results) +
                       vector_file(part.ports(), unit.operands(), results, vectors.all())});
}

}  // namespace

std::vector<host::File> core_files(const Core& core, const Library& library, CoreTest test) {
  const CycleTest cycles = test_of(core, std::move(test.cycles));
  std::vector<host::File> files{{core.module + ".v", to_verilog(core, library)},
                                {axi_module(core) + ".v", axi_verilog(core)},
                                {core.module + ".h", c_header(core)},
                                {core.module + ".rdl", system_rdl(core)},
                                {core.module + ".json", manifest_of(core, library).dump(2) + "\n"},
                                {core.module + ".core", fusesoc_text(core, library)},
                                {core.module + ".dot", core_picture(core)},
                                {axi_module(core) + ".dot", axi_picture(core)},
                                {"tb/" + core.module + "_tb.sv", testbench_text(cycles)},
                                {"tb/" + core.module + "_vectors.hex", vectors_text(cycles)},
                                {"tb/" + core.module + "_scene.txt", scene_text(core, test.scene)},
                                {"tb/Makefile", testbench_makefile()}};
  for (host::File& file : system_program(core)) files.push_back(std::move(file));
  std::size_t unit = 0;
  for (const Part& part : core.parts)
    if (part.pipeline && unit < test.units.size()) add_unit_test(files, part, test.units[unit++]);
  return with_licence(std::move(files));
}

}  // namespace hitpipe::rtl
