#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/process.hpp"
#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/emit/core_file.hpp"
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
  std::string verilog =
      to_verilog(pipeline, library, {.module_name = name, .bits = to_string(format), .flow_control = flow});
  const ModuleInterface unit = unit_interface(name, left, result_ports(results), flow);
  const int latency = pipeline.latency();
  Json json = manifest(design, format, unit, pipeline, library);
  if (options.axi_stream) json["axi_stream"] = stream_json(unit);
  if (from != nullptr) {
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
    emitted.hls = hls_top(design, format, name).files();
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
