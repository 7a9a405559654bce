#include "sim/unit/unit.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "rtl_gen/prune/check_block.hpp"
#include "rtl_gen/verilog/module.hpp"

namespace hitpipe::sim {

namespace {

rtl::ModuleInterface interface_of(const Unit& unit) {
  return rtl::unit_interface(unit.module, rtl::input_ports(unit.pipeline.graph),
                             rtl::result_ports(unit.design->results(unit.format)), unit.flow_control,
                             unit.pipeline.interval());
}

const rtl::PortDemand* demand_on(const Unit& unit, const std::vector<rtl::Port>& ports,
                                 std::optional<std::size_t> port) {
  if (!port) return nullptr;
  const auto& demands = unit.demands.ports;
  const auto found = std::find_if(demands.begin(), demands.end(), [&](const rtl::PortDemand& each) {
    return each.port == ports[*port].name;
  });
  return found == demands.end() ? nullptr : &*found;
}

[[noreturn]] void fail(const std::string& found, const std::string& demanded) {
  throw std::out_of_range(fmt::format(
      "operands outside the demands that the unit was fitted to: {}, demanded is {}", found, demanded));
}

}  // namespace

Unit make_unit(const rtl::Design& design, const rtl::Format& format, const rtl::Library& library,
               rtl::FlowControl flow, int interval) {
  return make_unit(design, format, library,
                   rtl::make_pipeline(design.trace(format), library, std::nullopt, interval), {}, flow);
}

Unit make_unit(const rtl::Design& design, const rtl::Format& format, const rtl::Library& library,
               rtl::Pipeline pipeline, rtl::Demands demands, rtl::FlowControl flow) {
  Unit unit{.design = &design,
            .format = format,
            .module = design.module_at(format),
            .pipeline = std::move(pipeline),
            .verilog = {},
            .flow_control = flow,
            .demands = std::move(demands)};
  unit.verilog = rtl::to_verilog(unit.pipeline, library,
                                 {.module_name = unit.module,
                                  .bits = rtl::to_string(format),
                                  .flow_control = flow,
                                  .operands = unit.ports(),
                                  .results = design.results(format)});
  if (unit.demands.empty()) return unit;
  const std::vector<rtl::Port> ports = unit.ports();
  unit.verilog =
      rtl::with_check_block(unit.verilog, rtl::check_block(interface_of(unit), unit.demands, ports));
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto origin = rtl::index_of(ports, hls::Role::origin, static_cast<hls::Axis>(axis + 1));
    if (const auto* const demand = demand_on(unit, ports, origin))
      unit.coarse.dropped[axis] = demand->low_zeros;
  }
  const auto* const endless = demand_on(unit, ports, rtl::index_of(ports, hls::Role::endless));
  unit.ends = endless == nullptr || hull(*endless) != rtl::Interval{1, 1};
  return unit;
}

Unit behind_ray_slots(Unit unit, int slots) {
  unit.ray_slots = rtl::ray_slots(interface_of(unit), unit.ports(), slots);
  unit.verilog += rtl::to_verilog(*unit.ray_slots);
  return unit;
}

DemandGuard::DemandGuard(const rtl::Demands& demands, const std::vector<rtl::Port>& ports) {
  for (std::size_t i = 0; i < ports.size(); ++i) {
    for (const rtl::PortDemand& demand : demands.ports)
      if (demand.port == ports[i].name) bounds_.push_back({i, demand});
    for (std::size_t j = 0; j < ports.size(); ++j)
      for (const rtl::OrderDemand& order : demands.orders)
        if (order.lesser == ports[i].name && order.greater == ports[j].name) orders_.push_back({i, j, order});
  }
}

void DemandGuard::operator()(const std::int64_t* operands) const {
  for (const Bound& bound : bounds_) {
    const std::int64_t number = operands[bound.port];
    if (rtl::meets(bound.demand, number)) continue;
    fail(fmt::format("{} = {}", bound.demand.port, number), rtl::demand_text(bound.demand));
  }
  for (const Order& order : orders_) {
    if (operands[order.lesser] <= operands[order.greater]) continue;
    fail(fmt::format("{} = {} and {} = {}", order.demand.lesser, operands[order.lesser], order.demand.greater,
                     operands[order.greater]),
         fmt::format("{} <= {}", order.demand.lesser, order.demand.greater));
  }
}

}  // namespace hitpipe::sim
