#include "rtl_gen/emit/files.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "host/process.hpp"
#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/emit/fusesoc.hpp"
#include "rtl_gen/emit/hls_top.hpp"
#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/port_vectors.hpp"
#include "rtl_gen/emit/result_fifo.hpp"
#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/schematic/dot.hpp"

namespace hitpipe::rtl {

namespace {

constexpr std::size_t drawn_vectors = 1000;
constexpr std::uint64_t vector_seed = 1;

void check_together(const Unit& unit, const EmitOptions& options) {
  if (options.fifo && unit.flow_control() == FlowControl::stall)
    throw std::invalid_argument(
        "result FIFO: flow control stall; allowed is none, because a unit that stalls holds its results");
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
std::string title_of(const Unit& unit) {
  const std::string title = unit.design->name_at(unit.format);
  return unit.module() == unit.design->module_at(unit.format) ? title
                                                              : fmt::format("{}: {}", unit.module(), title);
}

std::vector<File> stage_schematics(const Unit& unit, const std::string& title) {
  std::vector<File> files;
  for (const StageRange& group : stage_groups(*unit.pipeline)) {
    const std::string stages = group.first == group.last
                                   ? fmt::format("stage_{}", group.first)
                                   : fmt::format("stages_{}-{}", group.first, group.last);
    std::string words = stages;
    std::replace(words.begin(), words.end(), '_', ' ');
    files.push_back(
        {fmt::format("{}_{}.dot", unit.module(), stages),
         to_dot(*unit.pipeline, unit.ports(),
                fmt::format("{}: {} of {}", title, words, unit.pipeline->schedule.stages), group)});
  }
  return files;
}

/// Its simulations check the operands of a fitted unit.
std::string core_file(const Unit& unit, const Wrappers& around) {
  const std::string& module = unit.module();
  const bool fitted = !unit.demands.empty();
  const std::string defines = fitted ? ", -DHITPIPE_CHECK" : "";
  FuseSoc core{.name = "ray_box:" + module,
               .description = fmt::format("{} at {}{}", unit.design->summary, to_string(unit.format),
                                          fitted ? ", fitted" : "")};
  core.add_verilog("rtl", module);
  if (around.fifo) core.add_verilog("fifo", fifo_module(module));
  if (around.axi_stream) core.add_verilog("axis", stream_module(module));
  if (fitted) core.add_verilog("check", module + "_check");
  std::vector<std::string> sources{"rtl"};
  if (around.fifo) sources.emplace_back("fifo");
  if (around.axi_stream) sources.emplace_back("axis");
  const std::string top = around.axi_stream ? stream_module(module)
                          : around.fifo     ? fifo_module(module)
                                            : module;  // the outermost
  core.add_test("tb", {{"tb/" + top + "_tb.sv", "systemVerilogSource"}}, module + "_vectors.hex");
  core.add_test("harness", {{"tb/" + module + "_harness.cpp", "cppSource"}}, module + "_vectors.hex");
  core.targets.push_back({"default", "Verilog of the unit and its wrappers", sources, top});
  core.add_lint(sources, top);
  core.add_simulations(sources, top + "_tb", defines);
  core.add_harness({"rtl", "harness"}, module, defines);
  if (fitted)
    core.targets.push_back({"check",
                            "Lint the module that checks operands, with Verilator",
                            {"check"},
                            module + "_check",
                            "lint",
                            "{tool: verilator, verilator_options: [-Wall]}"});
  core.add_synthesis(unit.library, sources, top);
  return core.text();
}

}  // namespace

std::vector<File> EmittedDesign::files(const std::vector<File>& drawings) const {
  std::vector<File> all{verilog, {module + ".json", ""}, core, testbench, harness, makefile, vectors};
  all.insert(all.end(), more_testbenches.begin(), more_testbenches.end());
  if (check_module) all.push_back(*check_module);
  if (fifo) all.push_back(*fifo);
  if (axi_stream) all.push_back(*axi_stream);
  all.insert(all.end(), schematics.begin(), schematics.end());
  all.insert(all.end(), hls.begin(), hls.end());
  all.insert(all.end(), drawings.begin(), drawings.end());
  Json listing = *manifest;
  listing["files"] = Json::array();
  for (const File& file : all) listing["files"].push_back(file.name);
  all[1].contents = listing.dump(2) + "\n";
  return with_licence(std::move(all));
}

EmittedDesign emit(const Unit& unit, const EmitOptions& options) {
  check_together(unit, options);
  const ModuleInterface& interface = unit.interface;
  const std::string& name = unit.module();
  const bool fitted = !unit.demands.empty();
  const std::vector<Port> left = input_ports(unit.pipeline->graph);
  const std::vector<Port> ports = fitted ? unit.ports() : left;
  const std::vector<hls::Result> results = unit.design->results(unit.format);
  const std::string title = title_of(unit);
  VectorSet drawn;
  if (options.vectors == nullptr) {
    const Evaluate evaluate = unit.design->evaluate(unit.format);
    PortVectors at_ports({unit.pipeline->graph, ports, unit.demands, evaluate, results}, vector_seed);
    drawn = {vector_seed, at_ports.groups(drawn_vectors)};
  }
  const VectorSet& vectors = options.vectors == nullptr ? drawn : *options.vectors;
  const int latency = unit.pipeline->latency();
  const bool fifo = options.fifo || (options.axi_stream && unit.flow_control() == FlowControl::none);
  Json json = manifest(unit, unit.library);
  if (options.axi_stream) json["axi_stream"] = stream_json(interface);
  if (fitted) add_demands(json, unit.demands, unit.report);
  if (fifo) json["result_fifo"] = fifo_json(interface, latency);
  const int count = static_cast<int>(vectors.size());
  EmittedDesign emitted{
      .module = name,
      .verilog = {name + ".v", unit.verilog},
      .core = {name + ".core", core_file(unit, {.fifo = fifo, .axi_stream = options.axi_stream})},
      .testbench = {"tb/" + name + "_tb.sv", testbench(interface, count, latency)},
      .more_testbenches = {},
      .harness = {"tb/" + name + "_harness.cpp", harness(interface, count, latency)},
      .makefile = {"tb/Makefile", testbench_makefile()},
      .vectors = {"tb/" + name + "_vectors.hex",
                  vector_summary(title, vectors, results) + vector_file(ports, left, results, vectors.all())},
      .check_module = {},
      .fifo = {},
      .axi_stream = {},
      .schematics = stage_schematics(unit, title + (fitted ? ", fitted" : "")),
      .hls = {},
      .manifest = std::make_shared<const Json>(std::move(json))};
  if (fitted) emitted.check_module = {name + "_check.v", check_module(name + "_check", unit.demands, ports)};
  const auto add_testbench = [&](const std::string& top, const Wrappers& around) {
    emitted.more_testbenches.push_back(
        {"tb/" + top + "_tb.sv", testbench(interface, count, latency, around)});
  };
  if (fifo) add_testbench(fifo_module(name), {.fifo = true});
  if (options.axi_stream) add_testbench(stream_module(name), {.fifo = fifo, .axi_stream = true});
  if (fifo) emitted.fifo = {fifo_module(name) + ".v", result_fifo(interface, latency)};
  if (options.axi_stream) emitted.axi_stream = {stream_module(name) + ".v", axi_stream(interface)};
  if (options.hls) {
    emitted.hls = hls_top(*unit.design, unit.format, name, unit.interval()).files();
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

void add_drawings(std::vector<File>& files) {
  std::vector<File> schematics;
  for (const File& file : files)
    if (file.name.ends_with(".dot")) schematics.push_back(file);
  if (auto drawings = draw(schematics))
    for (File& drawing : *drawings) files.push_back(std::move(drawing));
}

}  // namespace hitpipe::rtl
