#include "rtl_gen/prune/demands.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/text.hpp"

namespace hitpipe::rtl {

namespace {

const Port& known_port(const std::vector<Port>& ports, const std::string& name) {
  if (const auto index = index_of(ports, name)) return ports[*index];
  std::vector<std::string> names;
  for (const Port& p : ports) names.push_back(p.name);
  throw std::invalid_argument(fmt::format("demand on {}: no such port; there are: {}", host::shortened(name),
                                          fmt::join(names, ", ")));
}

const PortDemand* demand_on(const Demands& demands, const std::string& port) {
  const auto found = std::find_if(demands.ports.begin(), demands.ports.end(),
                                  [&](const PortDemand& d) { return d.port == port; });
  return found == demands.ports.end() ? nullptr : &*found;
}

/// The demand on a port; all its numbers when there is none.
PortDemand demanded(const Demands& demands, const Port& port) {
  const PortDemand* const demand = demand_on(demands, port.name);
  return demand != nullptr ? *demand : PortDemand{port.name, {all_numbers(port)}};
}

bool lies_in(const std::vector<Interval>& within, const Interval& inner) {
  return std::any_of(within.begin(), within.end(), [&](const Interval& outer) {
    return outer.low <= inner.low && inner.high <= outer.high;
  });
}

std::uint64_t unit_of(const PortDemand& demand) {
  return std::uint64_t{1} << demand.low_zeros;
}

std::string interval_text(const Interval& i) {
  return i.low == i.high ? fmt::format("{}", i.low) : fmt::format("[{}, {}]", i.low, i.high);
}

void check_port_demand(const PortDemand& demand, const std::vector<Port>& ports) {
  const Port& port = known_port(ports, demand.port);
  const Interval all = all_numbers(port);
  if (demand.within.empty()) {
    throw std::invalid_argument(fmt::format("demand on {}: it allows no number", demand.port));
  }
  if (demand.low_zeros < 0 || demand.low_zeros >= port.width) {
    throw std::invalid_argument(fmt::format("demand on {}: {} low zeros, allowed are 0 to {}", demand.port,
                                            demand.low_zeros, port.width - 1));
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
    if (!multiples_in(each, demand.low_zeros)) {
      throw std::invalid_argument(fmt::format("demand on {}: {} holds no multiple of {}", demand.port,
                                              interval_text(each), unit_of(demand)));
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

std::optional<Interval> multiples_in(const Interval& interval, int low_zeros) {
  const std::uint64_t below = (std::uint64_t{1} << low_zeros) - 1;
  const auto low = static_cast<std::uint64_t>(interval.low);
  const auto high = static_cast<std::uint64_t>(interval.high);
  const std::uint64_t up = (0 - low) & below;
  if (up > high - low) return std::nullopt;
  return Interval{static_cast<std::int64_t>(low + up), static_cast<std::int64_t>(high & ~below)};
}

Interval hull(const PortDemand& demand) {
  return {multiples_in(demand.within.front(), demand.low_zeros)->low,
          multiples_in(demand.within.back(), demand.low_zeros)->high};
}

void check_demands(const Demands& demands, const std::vector<Port>& ports) {
  std::set<std::string> seen;
  for (const PortDemand& demand : demands.ports) {
    check_port_demand(demand, ports);
    if (!seen.insert(demand.port).second)
      throw std::invalid_argument(fmt::format("demand on {}: it is there twice", demand.port));
  }
  for (const OrderDemand& order : demands.orders) {
    const Port& lesser = known_port(ports, order.lesser);
    const Port& greater = known_port(ports, order.greater);
    if (lesser.width != greater.width || lesser.is_signed != greater.is_signed) {
      throw std::invalid_argument(
          fmt::format("demand {} <= {}: ports of different kinds", order.lesser, order.greater));
    }
    if (hull(demanded(demands, lesser)).low > hull(demanded(demands, greater)).high) {
      throw std::invalid_argument(
          fmt::format("demand {} <= {}: no number of one is", order.lesser, order.greater));
    }
  }
}

bool implies(const Demands& demands, const Demands& weaker, const std::vector<Port>& ports) {
  const auto port_implied = [&](const PortDemand& asked) {
    const PortDemand known = demanded(demands, known_port(ports, asked.port));
    return std::all_of(known.within.begin(), known.within.end(), [&](const Interval& each) {
      const Interval numbers = *multiples_in(each, known.low_zeros);
      const bool as_many_zeros = known.low_zeros >= asked.low_zeros ||
                                 (numbers.low == numbers.high && multiples_in(numbers, asked.low_zeros));
      return as_many_zeros && lies_in(asked.within, numbers);
    });
  };
  const auto order_implied = [&](const OrderDemand& asked) {
    if (std::find(demands.orders.begin(), demands.orders.end(), asked) != demands.orders.end()) return true;
    return hull(demanded(demands, known_port(ports, asked.lesser))).high <=
           hull(demanded(demands, known_port(ports, asked.greater))).low;
  };
  return std::all_of(weaker.ports.begin(), weaker.ports.end(), port_implied) &&
         std::all_of(weaker.orders.begin(), weaker.orders.end(), order_implied);
}

bool meets(const PortDemand& demand, std::int64_t number) {
  return lies_in(demand.within, {number, number}) && multiples_in({number, number}, demand.low_zeros);
}

bool meets(const Demands& demands, const std::vector<Port>& ports, const std::int64_t* operands) {
  const auto number = [&](const std::string& name) { return operands[index_of(ports, name).value()]; };
  return std::all_of(demands.ports.begin(), demands.ports.end(),
                     [&](const PortDemand& d) { return meets(d, number(d.port)); }) &&
         std::all_of(demands.orders.begin(), demands.orders.end(),
                     [&](const OrderDemand& d) { return number(d.lesser) <= number(d.greater); });
}

std::string demand_text(const PortDemand& demand) {
  const std::vector<Interval>& within = demand.within;
  if (within.size() == 1 && within[0].low == within[0].high)
    return fmt::format("{} = {}", demand.port, within[0].low);
  std::vector<std::string> texts;
  std::transform(within.begin(), within.end(), std::back_inserter(texts), interval_text);
  const std::string zeros =
      demand.low_zeros > 0 ? fmt::format(", a multiple of {}", unit_of(demand)) : std::string();
  return fmt::format("{} in {}{}", demand.port, fmt::join(texts, " or "), zeros);
}

std::string demand_text(const Demands& demands, std::size_t index) {
  if (index < demands.ports.size()) return demand_text(demands.ports[index]);
  const OrderDemand& order = demands.orders[index - demands.ports.size()];
  return fmt::format("{} <= {}", order.lesser, order.greater);
}

Demands set_up_demands(const std::vector<Port>& ports) {
  Demands all;
  for (const Port& port : ports)
    if (port.range && *port.range != all_numbers(port)) all.ports.push_back({port.name, {*port.range}});
  return all;
}

}  // namespace hitpipe::rtl
