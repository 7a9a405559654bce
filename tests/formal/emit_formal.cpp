// Writes what the proofs of one design in one format read: emit_formal DESIGN FORMAT FOLDER [SET [INTERVAL]].
// An empty FORMAT is the design's default. With SET, the number of a demand set or a manifest, the design is
// the fitted one. With "none" as SET the whole design has no flow control, with "stall" it has. It takes a
// test every INTERVAL cycles.
#include <algorithm>
#include <exception>
#include <iostream>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "host/files.hpp"
#include "host/text.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/prune/prune.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/formal/combinational.hpp"
#include "tests/formal/fifo.hpp"
#include "tests/formal/fitted_set.hpp"
#include "tests/formal/properties.hpp"

namespace {

using namespace hitpipe;

rtl::Graph fitted(const rtl::Design& design, hitpipe::Format format, const std::string& set) {
  return rtl::prune(design.trace(format), formal::fitted_set(design, format, set).demands, {.shares = false})
      .graph;
}

std::vector<rtl::File> files_of(const std::string& name, const std::string& given, const std::string& set,
                                int interval) {
  const rtl::Design& design = rtl::find_design(name);
  const hitpipe::Format bits = given.empty() ? design.default_format : design.parse_format(given);
  const std::string format = to_string(bits);
  const bool whole =
      set.empty() || std::count(rtl::flow_control_names.begin(), rtl::flow_control_names.end(), set) > 0;
  const auto flow = set == rtl::flow_control_name(rtl::FlowControl::none) ? rtl::FlowControl::none
                                                                          : rtl::FlowControl::stall;
  const bool stalls = flow == rtl::FlowControl::stall;
  const rtl::Graph traced = whole ? design.trace(bits) : fitted(design, bits, set);
  const rtl::Pipeline pipeline = rtl::make_pipeline(traced, rtl::Library::thesis(), std::nullopt, interval);
  const std::vector<formal::Component> parts = formal::components(pipeline, name, flow);

  std::string results;
  for (const rtl::Output& out : pipeline.graph.outputs()) results += fmt::format("w:{} ", out.name);
  std::string models;
  std::string names;
  std::set<formal::Symbol> symbols{formal::product_symbol()};
  std::vector<rtl::File> files{
      {"design.v", rtl::to_verilog(pipeline, rtl::Library::thesis(),
                                   {.module_name = name, .bits = format, .flow_control = flow})},
      {"reference.v", rtl::to_combinational_verilog(traced, fmt::format("{}_reference", name))},
      {"flow.v", formal::design_flow(pipeline, name, flow)},
      {"control.v", formal::control_properties(pipeline, flow)},
      {"format", format + "\n"},
      {"latency", fmt::format("{}\n", pipeline.latency())},
      {"interval", fmt::format("{}\n", interval)},
      {"results", results}};
  if (stalls) {
    files.push_back({"stalled.v", formal::stalled_design(pipeline, name)});
  } else {
    files.push_back({"fifo.v", formal::fifo_proof(name, design.ports(bits), pipeline.latency(), interval)});
  }
  for (const formal::Component& part : parts) {
    symbols.insert(part.symbol);
    models += part.model_text;
    names += fmt::format("{} {}\n", part.module, part.edges);
    files.push_back({part.module + ".v", part.reference_text + formal::component_flow(part)});
  }
  // In the reference a float operator is a module too, without stages.
  for (const auto& unit : pipeline.graph.submodules()) {
    const rtl::Output& result = unit->body.outputs().front();
    models += fmt::format(
        "module {0}_reference_{1} (\n  input wire {2}a, b,\n  output wire {3}{4}\n);\n"
        "  uf_{1} symbol (.a(a), .b(b), .y({4}));\nendmodule\n",
        name, unit->body.name(), rtl::vector_range(formal::operand_bits(*unit)),
        rtl::vector_range(unit->body[result.node].width), result.name);
  }
  std::string modules;
  std::string declarations;
  for (const formal::Symbol& symbol : symbols) {
    modules += formal::symbol_module(symbol);
    declarations += formal::symbol_declaration(symbol);
  }
  files.push_back({"models.v", models});
  files.push_back({"symbols.v", modules});
  files.push_back({"symbols.smt2", declarations});
  files.push_back({"components", names});
  return files;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 4 || argc > 6)
      throw std::runtime_error("usage: emit_formal DESIGN FORMAT FOLDER [SET [INTERVAL]]");
    const std::optional<int> interval = argc > 5 ? host::number_in<int>(argv[5]) : 1;
    if (!interval) throw std::runtime_error(std::string(argv[5]) + ": not an interval; allowed is 1 to 64");
    host::write_files(argv[3], files_of(argv[1], argv[2], argc > 4 ? argv[4] : "", *interval));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
  return 0;
}
