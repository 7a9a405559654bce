#include "rtl_gen/prune/demands.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace hitpipe::rtl {

namespace {

std::size_t index_of(const std::vector<Port>& ports, const std::string& name) {
  const auto found = std::find_if(ports.begin(), ports.end(), [&](const Port& p) { return p.name == name; });
  return static_cast<std::size_t>(found - ports.begin());
}

const Port& port_called(const std::vector<Port>& ports, const std::string& name) {
  const std::size_t index = index_of(ports, name);
  if (index < ports.size()) return ports[index];
  std::vector<std::string> names;
  for (const Port& p : ports) names.push_back(p.name);
  throw std::invalid_argument(
      fmt::format("demand on {}: no such port; there are: {}", name, fmt::join(names, ", ")));
}

const PortDemand* demand_on(const Demands& demands, const std::string& port) {
  const auto found = std::find_if(demands.ports.begin(), demands.ports.end(),
                                  [&](const PortDemand& d) { return d.port == port; });
  return found == demands.ports.end() ? nullptr : &*found;
}

/// The intervals that a port's number lies in, demanded or not.
std::vector<Interval> intervals_of(const Demands& demands, const Port& port) {
  const PortDemand* const demand = demand_on(demands, port.name);
  return demand != nullptr ? demand->within : std::vector<Interval>{all_numbers(port)};
}

bool lies_in(const std::vector<Interval>& within, const Interval& inner) {
  return std::any_of(within.begin(), within.end(), [&](const Interval& outer) {
    return outer.low <= inner.low && inner.high <= outer.high;
  });
}

std::string interval_text(const Interval& i) {
  return i.low == i.high ? fmt::format("{}", i.low) : fmt::format("[{}, {}]", i.low, i.high);
}

void check_port_demand(const PortDemand& demand, const std::vector<Port>& ports) {
  const Port& port = port_called(ports, demand.port);
  const Interval all = all_numbers(port);
  if (demand.within.empty()) {
    throw std::invalid_argument(fmt::format("demand on {}: it allows no number", demand.port));
  }
  for (std::size_t i = 0; i < demand.within.size(); ++i) {
    const Interval& each = demand.within[i];
    if (each.low > each.high || (i > 0 && each.low <= demand.within[i - 1].high)) {
      throw std::invalid_argument(
          fmt::format("demand on {}: {} does not ascend", demand.port, interval_text(each)));
    }
    if (each.low < all.low || each.high > all.high) {
      throw std::invalid_argument(fmt::format("demand on {}: {} is outside its {} bits, {}", demand.port,
                                              interval_text(each), port.width, interval_text(all)));
    }
  }
}

}  // namespace

Demands Demands::without(std::size_t index) const {
  Demands rest = *this;
  if (index < ports.size()) {
    rest.ports.erase(rest.ports.begin() + static_cast<std::ptrdiff_t>(index));
  } else {
    rest.orders.erase(rest.orders.begin() + static_cast<std::ptrdiff_t>(index - ports.size()));
  }
  return rest;
}

Interval all_numbers(const Port& port) {
  const int magnitude = std::min(port.width - (port.is_signed ? 1 : 0), 63);
  const auto most = static_cast<std::int64_t>((std::uint64_t{1} << magnitude) - 1);
  return {port.is_signed ? -most - 1 : 0, most};
}

Interval hull(const PortDemand& demand) {
  return {demand.within.front().low, demand.within.back().high};
}

void check_demands(const Demands& demands, const std::vector<Port>& ports) {
  std::set<std::string> seen;
  for (const PortDemand& demand : demands.ports) {
    check_port_demand(demand, ports);
    if (!seen.insert(demand.port).second)
      throw std::invalid_argument(fmt::format("demand on {}: it is there twice", demand.port));
  }
  for (const OrderDemand& order : demands.orders) {
    const Port& lesser = port_called(ports, order.lesser);
    const Port& greater = port_called(ports, order.greater);
    if (lesser.width != greater.width || lesser.is_signed != greater.is_signed) {
      throw std::invalid_argument(
          fmt::format("demand {} <= {}: ports of different kinds", order.lesser, order.greater));
    }
    if (intervals_of(demands, lesser).front().low > intervals_of(demands, greater).back().high) {
      throw std::invalid_argument(
          fmt::format("demand {} <= {}: no number of one is", order.lesser, order.greater));
    }
  }
}

bool implies(const Demands& demands, const Demands& weaker, const std::vector<Port>& ports) {
  const auto port_implied = [&](const PortDemand& asked) {
    const std::vector<Interval> known = intervals_of(demands, port_called(ports, asked.port));
    return std::all_of(known.begin(), known.end(),
                       [&](const Interval& each) { return lies_in(asked.within, each); });
  };
  const auto order_implied = [&](const OrderDemand& asked) {
    if (std::find(demands.orders.begin(), demands.orders.end(), asked) != demands.orders.end()) return true;
    const Interval lesser = intervals_of(demands, port_called(ports, asked.lesser)).back();
    const Interval greater = intervals_of(demands, port_called(ports, asked.greater)).front();
    return lesser.high <= greater.low;
  };
  return std::all_of(weaker.ports.begin(), weaker.ports.end(), port_implied) &&
         std::all_of(weaker.orders.begin(), weaker.orders.end(), order_implied);
}

bool meets(const Demands& demands, const std::vector<Port>& ports, const std::int64_t* operands) {
  const auto number = [&](const std::string& name) { return operands[index_of(ports, name)]; };
  return std::all_of(demands.ports.begin(), demands.ports.end(),
                     [&](const PortDemand& d) {
                       return lies_in(d.within, {number(d.port), number(d.port)});
                     }) &&
         std::all_of(demands.orders.begin(), demands.orders.end(),
                     [&](const OrderDemand& d) { return number(d.lesser) <= number(d.greater); });
}

std::string demand_text(const PortDemand& demand) {
  const std::vector<Interval>& within = demand.within;
  if (within.size() == 1 && within[0].low == within[0].high)
    return fmt::format("{} = {}", demand.port, within[0].low);
  std::vector<std::string> texts;
  std::transform(within.begin(), within.end(), std::back_inserter(texts), interval_text);
  return fmt::format("{} in {}", demand.port, fmt::join(texts, " or "));
}

std::string demand_text(const Demands& demands, std::size_t index) {
  if (index < demands.ports.size()) return demand_text(demands.ports[index]);
  const OrderDemand& order = demands.orders[index - demands.ports.size()];
  return fmt::format("{} <= {}", order.lesser, order.greater);
}

}  // namespace hitpipe::rtl
