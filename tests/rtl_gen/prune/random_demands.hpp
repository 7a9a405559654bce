// Random legal demands on any ports: constants, narrow and wide intervals, two intervals, low zeros, orders.
#pragma once

#include "tests/rtl_gen/prune/demand_sets.hpp"

namespace hitpipe::rtl {

inline Interval random_interval(Seeded& random, const Interval& all) {
  const auto any = [&] {
    const auto size = static_cast<std::uint64_t>(all.high - all.low) + 1;
    return all.low + static_cast<std::int64_t>(random.bits() % size);
  };
  const std::int64_t one = any();
  switch (random.below(4)) {
    case 0:
      return {one, one};
    case 1:
      return {one, std::min(all.high, one + random.below(8))};
    case 2:
      return {std::max<std::int64_t>(all.low, 0), all.high};
    default: {
      const std::int64_t two = any();
      return {std::min(one, two), std::max(one, two)};
    }
  }
}

/// Of half of the demands none; else as many as leave each interval a number.
inline int random_low_zeros(Seeded& random, const Port& port, const std::vector<Interval>& within) {
  int low_zeros = random.flip() ? 0 : random.below(port.width);
  const auto holds = [&](const Interval& each) { return multiples_in(each, low_zeros).has_value(); };
  while (!std::all_of(within.begin(), within.end(), holds)) --low_zeros;
  return low_zeros;
}

inline Demands random_demands(Seeded& random, const std::vector<Port>& ports) {
  Demands demands;
  for (const Port& port : ports) {
    if (random.below(4) == 0) continue;
    const Interval all = all_numbers(port);
    std::vector<Interval> within{random.below(4) == 0 ? all : random_interval(random, all)};
    if (random.flip() && within[0].high < all.high - 1)
      within.push_back(random_interval(random, {within[0].high + 2, all.high}));
    demands.ports.push_back({port.name, within, random_low_zeros(random, port, within)});
  }
  for (std::size_t a = 0; a < ports.size(); ++a) {
    for (std::size_t b = 0; b < ports.size(); ++b) {
      if (a == b || ports[a].width != ports[b].width || ports[a].is_signed != ports[b].is_signed) continue;
      const bool demanded = std::any_of(demands.ports.begin(), demands.ports.end(), [&](const PortDemand& d) {
        return d.port == ports[a].name || d.port == ports[b].name;
      });
      // On demanded ports an order could leave next to nothing to draw.
      if (!demanded && demands.orders.empty()) demands.orders.push_back({ports[a].name, ports[b].name});
    }
  }
  return demands;
}

}  // namespace hitpipe::rtl
