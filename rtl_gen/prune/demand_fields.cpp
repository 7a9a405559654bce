#include "rtl_gen/prune/demand_fields.hpp"

#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace hitpipe::rtl {

namespace {

using Json = nlohmann::ordered_json;

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

}  // namespace

std::string with_demand_fields(const std::string& manifest, const Demands& demands,
                               const PruneReport& report) {
  if (demands.empty()) return manifest;
  Json json = Json::parse(manifest);
  json["demands"] = demands_json(demands);
  json["dropped_ports"] = report.dropped_ports();
  json["narrowed_ports"] = Json::array();
  for (const PortChange& change : report.ports) {
    if (change.bits_after == 0) continue;
    json["narrowed_ports"].push_back(
        {{"name", change.port}, {"from", change.bits_before}, {"to", change.bits_after}});
  }
  json["left_out"] = Json::array();
  for (const Cut& cut : report.cuts) json["left_out"].push_back(cut_text(cut));
  return json.dump(2) + "\n";
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
