#include "rtl_gen/emit/manifest.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "host/text.hpp"
#include "rtl_gen/emit/licence.hpp"
#include "rtl_gen/machine/module.hpp"
#include "rtl_gen/verilog/names.hpp"

namespace hitpipe::rtl {

namespace {

Json demands_json(const Demands& demands) {
  Json list = Json::array();
  for (const PortDemand& demand : demands.ports) {
    Json within = Json::array();
    for (const Interval& each : demand.within) within.push_back({each.low, each.high});
    list.push_back({{"port", demand.port}, {"within", within}});
    if (demand.low_zeros > 0) list.back()["low_zeros"] = demand.low_zeros;
  }
  for (const OrderDemand& order : demands.orders)
    list.push_back({{"lesser", order.lesser}, {"greater", order.greater}});
  return list;
}

Json results_json(const std::vector<hls::Result>& results) {
  Json list = Json::array();
  for (const hls::Result& result : results) {
    list.push_back({{"name", result.name},
                    {"meaning", meaning_names.at(static_cast<std::size_t>(result.meaning))},
                    {"box", result.box},
                    {"width", result.width}});
  }
  return list;
}

Json stages(const Pipeline& pipeline) {
  Json list = Json::array();
  for (int stage = 0; stage <= pipeline.schedule.stages; ++stage) {
    std::map<std::string, int> components;
    for (NodeId id = 0; id < pipeline.graph.size(); ++id) {
      if (pipeline.binding.shares(id)) continue;
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

/// The components that several operations share, and of how many operations each.
Json shared_components(const Pipeline& pipeline) {
  Json list = Json::array();
  for (const auto& [instance, operations] : pipeline.binding.instances()) {
    const ComponentUse use = component_of(pipeline.graph, operations.front());
    list.push_back({{"component", fmt::format("{}_{}", component_name(use.component), use.bits)},
                    {"operations", operations.size()}});
  }
  return list;
}

Json fields_json(const std::vector<hls::Field>& fields) {
  Json list = Json::array();
  for (const hls::Field& field : fields) {
    list.push_back({{"name", field.name}, {"width", field.width}, {"signed", field.is_signed}});
    if (field.has_reset) list.back()["reset"] = field.reset;
  }
  return list;
}

/// Results come in the order of the tests.
std::string handshake(const ModuleInterface& unit) {
  if (unit.flow_control() == FlowControl::stall)
    return fmt::format("valid/ready;{} results in order; the whole pipeline waits for out_ready",
                       unit.interval == 1 ? "" : " in_ready in one of `ii` cycles;");
  return fmt::format("valid{}; results in order, each `latency` cycles after its operands; nothing waits",
                     unit.interval == 1 ? "" : ", and in_ready in one of `ii` cycles");
}

}  // namespace

Json ports_json(const ModuleInterface& interface) {
  Json list = Json::array();
  for (const Pin& pin : interface.pins) {
    const Json width = pin.width == Pin::tag_width ? Json("TAG_BITS") : Json(pin.width);
    list.push_back({{"name", pin.name},
                    {"direction", pin.is_input ? "in" : "out"},
                    {"width", width},
                    {"signed", pin.is_signed}});
  }
  return list;
}

Json module_json(const Format& format, const ModuleInterface& interface) {
  return {{"bits", to_string(format)},   {"module", interface.module},
          {"license", output_licence},   {"verilog", {interface.module + ".v"}},
          {"clock", "clk, rising edge"}, {"reset", "rst, synchronous, active high"}};
}

Json memories_json(const MachineGraph& machine) {
  Json list = Json::array();
  for (const hls::MemoryShape& memory : machine.memories)
    list.push_back({{"name", memory.name},
                    {"words", memory.words},
                    {"width", memory.width},
                    {"kind", memory.kind_name()}});
  return list;
}

Json manifest(const Part& part, const Library& library) {
  Json json{{part.design != nullptr ? "design" : "machine", part.name}};
  if (part.design != nullptr) json["kind"] = part.design->kind.name;
  json.update(module_json(part.format, part.interface));
  if (part.design != nullptr) {
    json["reset"] = "rst, synchronous, active high, valid bits only";
    json["flow_control"] = flow_control_name(part.interface.flow_control());
    json["handshake"] = handshake(part.interface);
    json["parameters"] = {{"TAG_BITS", 16}};
  }
  json["ports"] = ports_json(part.interface);
  if (part.design != nullptr) {
    json["results"] = results_json(part.design->results(part.format));
    json["stages"] = part.pipeline->schedule.stages;
    json["latency"] = part.pipeline->latency();
  }
  json["clock_ps"] = part.clock_ps(library);
  json["library"] = library.name();
  if (part.design != nullptr) {
    json["by_stage"] = stages(*part.pipeline);
    if (part.pipeline->interval() > 1) {
      json["ii"] = part.pipeline->interval();
      json["shared"] = shared_components(*part.pipeline);
    }
  } else {
    json["longest_path"] = longest_path(*part.graph, library).names;
    json["registers"] = fields_json(part.graph->state);
    json["memories"] = memories_json(*part.graph);
  }
  return json;
}

void add_demands(Json& manifest, const Demands& demands, const PruneReport& report) {
  if (demands.empty()) return;
  manifest["demands"] = demands_json(demands);
  manifest["dropped_ports"] = report.dropped_ports();
  manifest["narrowed_ports"] = Json::array();
  for (const PortChange& change : report.ports) {
    if (change.bits_after == 0) continue;
    manifest["narrowed_ports"].push_back(
        {{"name", change.port}, {"from", change.bits_before}, {"to", change.bits_after}});
  }
  manifest["left_out"] = Json::array();
  for (const Cut& cut : report.cuts) manifest["left_out"].push_back(cut_text(cut));
}

namespace {

FlowControl flow_control_of(const Json& json) {
  // Manifests of older versions do not say it.
  const std::string word = json.value("flow_control", std::string(flow_control_name(FlowControl::stall)));
  const auto found = std::find(flow_control_names.begin(), flow_control_names.end(), word);
  if (found == flow_control_names.end())
    throw std::runtime_error(fmt::format("\"flow_control\" is \"{}\", allowed are {}", host::shortened(word),
                                         fmt::join(flow_control_names, ", ")));
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
                      json.value("ii", 1),
                      json.value("files", std::vector<std::string>{})};
    check_module_name(head.module);
    return head;
  } catch (const Json::exception&) {
    throw std::runtime_error("no manifest: it must be JSON with design, bits, module and latency");
  }
}

Demands demands_of_manifest(const std::string& manifest) {
  Demands demands;
  try {
    const Json json = Json::parse(manifest);
    if (!json.contains("demands")) return demands;
    for (const Json& each : json.at("demands")) {
      if (!each.contains("port")) {
        demands.orders.push_back(
            {each.at("lesser").get<std::string>(), each.at("greater").get<std::string>()});
        continue;
      }
      PortDemand demand{each.at("port").get<std::string>(), {}, each.value("low_zeros", 0)};
      for (const Json& within : each.at("within"))
        demand.within.push_back({within.at(0).get<std::int64_t>(), within.at(1).get<std::int64_t>()});
      demands.ports.push_back(std::move(demand));
    }
  } catch (const Json::exception&) {
    throw std::runtime_error("manifest: \"demands\" is not a list of demands");
  }
  return demands;
}

}  // namespace hitpipe::rtl
