#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/process.hpp"
#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/emit/hls_top.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/port_vectors.hpp"
#include "rtl_gen/emit/ray_slots.hpp"
#include "rtl_gen/emit/result_fifo.hpp"
#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/schematic/dot.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

namespace {

constexpr std::size_t drawn_vectors = 1000;
constexpr std::uint64_t vector_seed = 1;

void check_together(const EmitOptions& options) {
  if (options.axi_stream && options.ray_slots)
    throw std::invalid_argument("AXI4-Stream and ray slots: a unit has one wrapper or the other");
  if (options.fifo && options.ray_slots)
    throw std::invalid_argument("result FIFO and ray slots: a unit has one wrapper or the other");
  if (options.fifo && options.flow_control == FlowControl::stall)
    throw std::invalid_argument(
        "result FIFO: flow control stall; allowed is none, because a unit that stalls holds its results");
  if (options.ray_slots) check_ray_slots(options.flow_control);
}

/// Nothing when dot is not installed.
std::optional<File> drawing_of(const File& dot) {
  host::Outcome drawn =
      host::run({"dot", "-Tsvg"}, {.input = dot.contents, .time_limit = host::answering_time});
  if (drawn.not_found()) return std::nullopt;
  if (!drawn.succeeded() || drawn.out.empty())
    throw std::runtime_error(fmt::format("{}: Graphviz's dot {}", dot.name, drawn.failure()));
  return File{std::filesystem::path(dot.name).replace_extension(".svg").string(), std::move(drawn.out)};
}

/// "int_slabs 20/24"; of a unit that the user named also that name: "box_test: int_slabs 20/24".
std::string title_of(const Design& design, const Format& format, const std::string& module) {
  const std::string title = design.name_at(format);
  return module == design.module_at(format) ? title : fmt::format("{}: {}", module, title);
}

std::vector<File> stage_schematics(const Pipeline& pipeline, const std::vector<Port>& ports,
                                   const std::string& name, const std::string& title) {
  std::vector<File> files;
  for (const StageRange& group : stage_groups(pipeline)) {
    const std::string stages = group.first == group.last
                                   ? fmt::format("stage_{}", group.first)
                                   : fmt::format("stages_{}-{}", group.first, group.last);
    std::string words = stages;
    std::replace(words.begin(), words.end(), '_', ' ');
    files.push_back({fmt::format("{}_{}.dot", name, stages),
                     to_dot(pipeline, ports,
                            fmt::format("{}: {} of {}", title, words, pipeline.schedule.stages), group)});
  }
  return files;
}

struct CoreParts {
  bool axi_stream = false;  ///< a fileset axis; the wrapper is the top of default, lint and synth
  bool fifo = false;        ///< a fileset fifo; that wrapper is the top of the same, if there is no axis
  std::string slots{};      ///< module of the wrapper with ray slots: a fileset slots, top of the same
  bool check = false;  ///< for a fitted unit: fileset and target check (lint); simulations check operands
};

constexpr const char* check_target = R"(  check:
    flow: lint
    flow_options: {{tool: verilator, verilator_options: [-Wall]}}
    filesets: [check]
    toplevel: {}_check
)";

/// The FuseSoC core file (CAPI 2, flow API). Its targets are default, lint (Verilator), sim (Icarus),
/// sim_verilator, harness (C++ around the Verilated unit), synth (Yosys) and synth_vivado. Paths are relative
/// to the core file.
std::string core_file(const Design& design, Format format, const std::string& module,
                      const CoreParts& parts) {
  const bool slots = !parts.slots.empty();
  const std::string top = slots              ? parts.slots
                          : parts.axi_stream ? stream_module(module)
                          : parts.fifo       ? fifo_module(module)
                                             : module;
  const std::string filesets = fmt::format("[rtl{}{}{}]", slots ? ", slots" : "", parts.fifo ? ", fifo" : "",
                                           parts.axi_stream ? ", axis" : "");
  const auto fileset = [](bool there, const std::string& name, const std::string& top_module) {
    return there ? fmt::format("  {}:\n    files: [{}.v]\n    file_type: verilogSource\n", name, top_module)
                 : "";
  };
  const std::string more = fileset(parts.fifo, "fifo", fifo_module(module)) +
                           fileset(parts.axi_stream, "axis", top) + fileset(slots, "slots", top) +
                           fileset(parts.check, "check", module + "_check");
  // A simulator runs in the work root, where the testbench looks for its vectors: they are copied there.
  return fmt::format(R"(CAPI=2:
# Generated by hitpipe; do not edit.
name: "hitpipe:ray_box:{0}:{9}"
description: "{1} at {2}{7}"

filesets:
  rtl:
    files: [{0}.v]
    file_type: verilogSource
{3}  tb:
    files:
      - tb/{0}_tb.sv: {{file_type: systemVerilogSource}}
      - tb/{0}_vectors.hex: {{file_type: user, copyto: {0}_vectors.hex}}
  harness:
    files:
      - tb/{0}_harness.cpp: {{file_type: cppSource}}
      - tb/{0}_vectors.hex: {{file_type: user, copyto: {0}_vectors.hex}}

targets:
  default:
    filesets: {4}
    toplevel: {5}
  lint:
    flow: lint
    flow_options: {{tool: verilator, verilator_options: [-Wall]}}
    filesets: {4}
    toplevel: {5}
  sim:
    flow: sim
    flow_options: {{tool: icarus, iverilog_options: [-g2012, -Wall{6}]}}
    filesets: [rtl, tb]
    toplevel: {0}_tb
  sim_verilator:
    flow: sim
    flow_options: {{tool: verilator, mode: binary, verilator_options: [-Wall{6}]}}
    filesets: [rtl, tb]
    toplevel: {0}_tb
  harness:
    flow: sim
    flow_options: {{tool: verilator, mode: cc, verilator_options: [-Wall{6}]}}
    filesets: [rtl, harness]
    toplevel: {0}
  synth:
    flow: generic
    flow_options: {{tool: yosys, arch: xilinx, output_format: edif}}
    filesets: {4}
    toplevel: {5}
  synth_vivado:
    flow: vivado
    flow_options: {{part: xc7a100tcsg324-1, pnr: none}}
    filesets: {4}
    toplevel: {5}
{8})",
                     module, design.summary, to_string(format), more, filesets, top,
                     parts.check ? ", -DHITPIPE_CHECK" : "", parts.check ? ", fitted" : "",
                     parts.check ? fmt::format(check_target, module) : "", HITPIPE_VERSION);
}

}  // namespace

std::vector<File> EmittedDesign::files(const std::vector<File>& drawings) const {
  std::vector<File> all{verilog, {module + ".json", ""}, core, testbench, harness, makefile, vectors};
  if (check_module) all.push_back(*check_module);
  if (fifo) all.push_back(*fifo);
  if (axi_stream) all.push_back(*axi_stream);
  if (ray_slots) all.push_back(*ray_slots);
  all.insert(all.end(), schematics.begin(), schematics.end());
  all.insert(all.end(), hls.begin(), hls.end());
  all.insert(all.end(), drawings.begin(), drawings.end());
  Json listing = *manifest;
  listing["files"] = Json::array();
  for (const File& file : all) listing["files"].push_back(file.name);
  all[1].contents = listing.dump(2) + "\n";
  return all;
}

File EmittedDesign::manifest_file() const {
  return files()[1];
}

EmittedDesign emit(const Design& design, Format format, const Library& library, const Pipeline& pipeline,
                   const EmitOptions& options) {
  check_together(options);
  const FlowControl flow = options.flow_control;
  const PrunedFrom* const from = options.pruned_from;
  const std::vector<Port> left = input_ports(pipeline.graph);
  const std::vector<hls::Result> results = design.results(format);
  const std::string name = options.module.empty() ? design.module_at(format) : options.module;
  check_module_name(name);
  const std::string title = title_of(design, format, name);
  const std::vector<Port> ports = from == nullptr ? left : from->ports;
  VectorSet drawn;
  if (options.vectors == nullptr) {
    const Evaluate evaluate = design.evaluate(format);
    const Demands demands = from == nullptr ? Demands{} : from->demands;
    PortVectors at_ports({pipeline.graph, ports, demands, evaluate, results}, vector_seed);
    drawn = {vector_seed, at_ports.groups(drawn_vectors)};
  }
  const VectorSet& vectors = options.vectors == nullptr ? drawn : *options.vectors;
  std::string verilog = options.verilog != nullptr ? *options.verilog
                                                   : to_verilog(pipeline, library,
                                                                {.module_name = name,
                                                                 .bits = to_string(format),
                                                                 .flow_control = flow,
                                                                 .operands = design.ports(format),
                                                                 .results = results});
  const ModuleInterface unit = unit_interface(name, left, result_ports(results), flow, pipeline.interval());
  const int latency = pipeline.latency();
  Json json = manifest(design, format, unit, pipeline, library);
  if (options.axi_stream) json["axi_stream"] = stream_json(unit);
  if (from != nullptr) {
    if (options.verilog == nullptr)
      verilog = with_check_block(verilog, check_block(unit, from->demands, from->ports));
    add_demands(json, from->demands, from->report);
  }
  const int count = static_cast<int>(vectors.size());
  std::optional<RaySlots> slots;
  if (options.ray_slots) {
    slots = ray_slots(unit, design.ports(format), *options.ray_slots);
    json["ray_slots"] = ray_slots_json(*slots, latency);
  }
  const bool fifo = options.fifo || (options.axi_stream && flow == FlowControl::none);
  if (fifo) json["result_fifo"] = fifo_json(unit, latency);
  const CoreParts parts{.axi_stream = options.axi_stream,
                        .fifo = fifo,
                        .slots = slots ? slots->module() : "",
                        .check = from != nullptr};
  EmittedDesign emitted{
      .module = name,
      .verilog = {name + ".v", std::move(verilog)},
      .core = {name + ".core", core_file(design, format, name, parts)},
      .testbench = {"tb/" + name + "_tb.sv", testbench(unit, count, latency)},
      .harness = {"tb/" + name + "_harness.cpp", harness(unit, count, latency)},
      .makefile = {"tb/Makefile", testbench_makefile()},
      .vectors = {"tb/" + name + "_vectors.hex",
                  vector_summary(title, vectors, results) + vector_file(ports, left, results, vectors.all())},
      .check_module = {},
      .fifo = {},
      .axi_stream = {},
      .ray_slots = {},
      .schematics =
          stage_schematics(pipeline, design.ports(format), name, title + (from == nullptr ? "" : ", fitted")),
      .hls = {},
      .manifest = std::make_shared<const Json>(std::move(json))};
  if (from != nullptr)
    emitted.check_module = {name + "_check.v", check_module(name + "_check", from->demands, from->ports)};
  if (fifo) emitted.fifo = {fifo_module(name) + ".v", result_fifo(unit, latency)};
  if (options.axi_stream) emitted.axi_stream = {stream_module(name) + ".v", axi_stream(unit)};
  if (slots) emitted.ray_slots = {slots->module() + ".v", to_verilog(*slots)};
  if (options.hls) {
    emitted.hls = hls_top(design, format, name, pipeline.interval()).files();
    for (File& file : emitted.hls) file.name.insert(0, "hls/");
  }
  return emitted;
}

std::optional<std::vector<File>> draw(const std::vector<File>& schematics) {
  std::vector<File> drawings;
  for (const File& schematic : schematics) {
    std::optional<File> drawing = drawing_of(schematic);
    if (!drawing) return std::nullopt;
    drawings.push_back(*std::move(drawing));
  }
  return drawings;
}

}  // namespace hitpipe::rtl
