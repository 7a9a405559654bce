#include "rtl_gen/emit/manifest.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/axi_stream.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

namespace {

using Json = nlohmann::ordered_json;

const char* word_of(hls::Meaning meaning) {
  switch (meaning) {
    case hls::Meaning::hit:
      return "hit";
    case hls::Meaning::entry:
      return "entry";
    case hls::Meaning::exit:
      return "exit";
    case hls::Meaning::order:
      return "order";
  }
  throw std::logic_error("a result without a meaning");
}

Json results_json(const std::vector<hls::Result>& results) {
  Json list = Json::array();
  for (const hls::Result& result : results) {
    list.push_back({{"name", result.name},
                    {"meaning", word_of(result.meaning)},
                    {"box", result.box},
                    {"width", result.width}});
  }
  return list;
}

Json ports(const Graph& graph, const std::vector<hls::Result>& results, FlowControl flow) {
  Json list = Json::array();
  const auto add = [&](const std::string& name, const char* direction, const Json& width, bool is_signed) {
    list.push_back({{"name", name}, {"direction", direction}, {"width", width}, {"signed", is_signed}});
  };
  for (const char* name : {"clk", "rst", "in_valid"}) add(name, "in", 1, false);
  if (flow == FlowControl::stall) add("in_ready", "out", 1, false);
  add("in_tag", "in", "TAG_BITS", false);
  add("out_valid", "out", 1, false);
  if (flow == FlowControl::stall) add("out_ready", "in", 1, false);
  add("out_tag", "out", "TAG_BITS", false);
  for (const NodeId id : graph.inputs()) add(graph[id].name, "in", graph[id].width, graph[id].is_signed);
  for (const hls::Result& result : results) add(result.name, "out", result.width, result.is_signed);
  return list;
}

Json stages(const Pipeline& pipeline) {
  Json list = Json::array();
  for (int stage = 0; stage <= pipeline.schedule.stages; ++stage) {
    std::map<std::string, int> components;
    for (NodeId id = 0; id < pipeline.graph.size(); ++id) {
      if (!is_component(pipeline.graph[id].op) || pipeline.schedule.slots[id].stage != stage) continue;
      const ComponentUse use = component_of(pipeline.graph, id);
      ++components[fmt::format("{}_{}", component_name(use.component), use.bits)];
    }
    int latch_bits = 0;
    for (const Register& r : pipeline.placement.registers) {
      if (r.boundary != stage) continue;
      ++components[fmt::format("latch_{}", r.width())];
      latch_bits += r.width();
    }
    list.push_back({{"stage", stage}, {"components", components}, {"latch_bits", latch_bits}});
  }
  return list;
}

/// Of one direction.
Json stream_side(const std::vector<Port>& ports) {
  Json fields = Json::array();
  for (const StreamField& field : stream_fields(ports))
    fields.push_back({{"name", field.name}, {"offset", field.offset}, {"width", field.width}});
  return {{"tdata_bits", stream_bits(ports)}, {"fields", fields}};
}

Json stream_json(const std::string& module, const std::vector<Port>& ports,
                 const std::vector<hls::Result>& results) {
  return {{"module", stream_module(module)},
          {"file", stream_module(module) + ".v"},
          {"clock", "aclk, rising edge"},
          {"reset", "aresetn, synchronous, active low"},
          {"tid", "the tag, TAG_BITS"},
          {"s_axis", stream_side(ports)},
          {"m_axis", stream_side(result_ports(results))}};
}

}  // namespace

std::string manifest(const Design& design, Format format, const std::string& module, const Pipeline& pipeline,
                     const Library& library, bool stream, FlowControl flow) {
  const std::vector<hls::Result> results = design.results(format);
  Json json{
      {"design", std::string(design.name)},
      {"kind", design.kind.name},
      {"bits", to_string(format)},
      {"module", module},
      {"verilog", {module + ".v"}},
      {"clock", "clk, rising edge"},
      {"reset", "rst, synchronous, active high, valid bits only"},
      {"flow_control", flow_control_name(flow)},
      {"handshake", flow == FlowControl::stall
                        ? "valid/ready; results in order; the whole pipeline waits for out_ready"
                        : "valid; results in order, each `latency` cycles after its operands; nothing waits"},
      {"parameters", {{"TAG_BITS", 16}}},
      {"ports", ports(pipeline.graph, results, flow)},
      {"results", results_json(results)},
      {"stages", pipeline.schedule.stages},
      {"latency", pipeline.latency()},
      {"clock_ps", pipeline.schedule.clock_ps},
      {"library", library.name()},
      {"by_stage", stages(pipeline)}};
  if (stream) json["axi_stream"] = stream_json(module, input_ports(pipeline.graph), results);
  return json.dump(2) + "\n";
}

std::string with_files(const std::string& manifest, const std::vector<std::string>& files) {
  Json json = Json::parse(manifest);
  json["files"] = files;
  return json.dump(2) + "\n";
}

namespace {

FlowControl flow_control_of(const Json& json) {
  // Manifests of older versions do not say it.
  const std::string word = json.value("flow_control", std::string(flow_control_name(FlowControl::stall)));
  const auto found = std::find(flow_control_names.begin(), flow_control_names.end(), word);
  if (found == flow_control_names.end())
    throw std::runtime_error(
        fmt::format("\"flow_control\" is \"{}\", allowed are {}", word, fmt::join(flow_control_names, ", ")));
  return static_cast<FlowControl>(found - flow_control_names.begin());
}

}  // namespace

ManifestHead head_of(const std::string& manifest) {
  try {
    const Json json = Json::parse(manifest);
    ManifestHead head{json.at("design").get<std::string>(),
                      json.at("bits").get<std::string>(),
                      json.at("module").get<std::string>(),
                      json.at("latency").get<int>(),
                      flow_control_of(json),
                      json.value("files", std::vector<std::string>{})};
    check_module_name(head.module);
    return head;
  } catch (const Json::exception&) {
    throw std::runtime_error("no manifest: it must be JSON with design, bits, module and latency");
  }
}

}  // namespace hitpipe::rtl
