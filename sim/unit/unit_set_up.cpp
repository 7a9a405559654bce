#include "sim/unit/unit_set_up.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

namespace hitpipe::sim {

namespace {

const rtl::PortDemand* demand_on(const rtl::Unit& unit, const std::vector<rtl::Port>& ports,
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

ref::CoarseAxes coarse_axes(const rtl::Unit& unit) {
  ref::CoarseAxes coarse;
  const std::vector<rtl::Port> ports = unit.ports();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto origin = rtl::index_of(ports, hls::Role::origin, static_cast<hls::Axis>(axis + 1));
    if (const auto* const demand = demand_on(unit, ports, origin)) coarse.dropped[axis] = demand->low_zeros;
  }
  return coarse;
}

bool takes_ends(const rtl::Unit& unit) {
  const std::vector<rtl::Port> ports = unit.ports();
  const auto* const endless = demand_on(unit, ports, rtl::index_of(ports, hls::Role::endless));
  return endless == nullptr || hull(*endless) != rtl::Interval{1, 1};
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
