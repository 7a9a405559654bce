#include "sim/fit/port_demands.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "rtl_gen/prune/facts.hpp"
#include "sim/fit/port_ranges.hpp"
#include "sim/port_names.hpp"

namespace hitpipe::sim {

namespace {

class Groups {
 public:
  explicit Groups(const rtl::Design& design, rtl::Format format)
      : ports_(rtl::input_ports(design.trace(format))) {}

  /// Promises `range` of the ports if the design has them and they lose a bit by it beside the `spare` ones
  /// that they never use.
  void add(const std::string& why, const std::vector<std::string>& names, const Range& range, int spare) {
    if (!range) return;
    rtl::Demands demands;
    for (const std::string& name : names) {
      const auto port =
          std::find_if(ports_.begin(), ports_.end(), [&](const auto& p) { return p.name == name; });
      if (port == ports_.end() || !loses_bits(*port, *range, spare)) continue;
      demands.ports.push_back({name, {*range}});
    }
    if (demands.empty()) return;
    if (!groups_.empty() && groups_.back().why == why) {
      auto& known = groups_.back().demands.ports;
      known.insert(known.end(), demands.ports.begin(), demands.ports.end());
    } else {
      groups_.push_back({why, std::move(demands)});
    }
  }
  /// Promises so many low zeros of the ports.
  void add_low_zeros(const std::string& why, const std::vector<std::string>& names, int low_zeros) {
    DemandGroup group{why, {}};
    for (const rtl::Port& port : ports_) {
      if (std::find(names.begin(), names.end(), port.name) != names.end())
        group.demands.ports.push_back({port.name, {rtl::all_numbers(port)}, low_zeros});
    }
    groups_.push_back(std::move(group));
  }
  [[nodiscard]] std::vector<DemandGroup> take() { return std::move(groups_); }

 private:
  static bool loses_bits(const rtl::Port& port, const rtl::Interval& range, int spare) {
    if (!port.is_signed) return true;  // a float's: one sign, or one number
    return range.low >= 0 || range.high < 0 ||
           rtl::Facts::number(port.width, range.low, range.high).signed_width() < port.width - spare;
  }

  std::vector<rtl::Port> ports_;
  std::vector<DemandGroup> groups_;
};

std::string bounds(const char* what, int axis, float low, float high) {
  return low == high ? fmt::format("{}.{} is always {:.6g}", what, "xyz"[axis], low)
                     : fmt::format("{}.{} lies within {:.6g} .. {:.6g}", what, "xyz"[axis], low, high);
}

std::string direction_text(const ref::SceneDemands& scene, int axis) {
  ref::Aabb all;
  for (const ref::RayFamily& family : scene.rays) all.grow(family.direction);
  return bounds("direction", axis, all.min[axis], all.max[axis]);
}

void add_integer(Groups& groups, int coord_bits, const ref::SceneDemands& scene, const Precision& precision) {
  // The cube's margin leaves one bit of every coordinate unused, in every scene.
  constexpr int spare = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const PortNames names = names_of(axis);
    const ref::Aabb origins = scene.origins();
    groups.add(bounds("ray origin", axis, origins.min[axis], origins.max[axis]), {"i" + names.origin},
               int_origin(scene, axis, coord_bits, precision.coarse), spare);
    groups.add(bounds("box", axis, scene.boxes.min[axis], scene.boxes.max[axis]),
               {"i" + names.low, "i" + names.high}, int_box(scene, axis, coord_bits, precision.coarse),
               spare);
    const std::string direction = direction_text(scene, axis);
    if (const auto irdvc = int_irdvc(scene, axis, coord_bits)) {
      groups.add(direction, {"i" + names.direction + "_floor"}, irdvc->floor, 0);
      groups.add(direction, {"i" + names.direction + "_ceil"}, irdvc->ceil, 0);
    }
    groups.add(direction, {"i" + names.direction}, int_direction(scene, axis, coord_bits), 0);
  }
  for (int axis = 0; axis < 3; ++axis) {
    const PortNames names = names_of(axis);
    const int dropped = precision.coarse.dropped[static_cast<std::size_t>(axis)];
    if (dropped == 0) continue;
    groups.add_low_zeros(measured_text(precision.coarse_extra_box_tests_pct),
                         {"i" + names.origin, "i" + names.low, "i" + names.high}, dropped);
  }
}

void add_float(Groups& groups, const ref::SceneDemands& scene) {
  for (int axis = 0; axis < 3; ++axis) {
    const PortNames names = names_of(axis);
    const ref::Aabb origins = scene.origins();
    groups.add(bounds("ray origin", axis, origins.min[axis], origins.max[axis]), {names.origin},
               float_range(origins.min[axis], origins.max[axis]), 0);
    groups.add(bounds("box", axis, scene.boxes.min[axis], scene.boxes.max[axis]), {names.low, names.high},
               float_range(scene.boxes.min[axis], scene.boxes.max[axis]), 0);
    const std::string direction = direction_text(scene, axis);
    groups.add(direction, {names.direction}, float_direction(scene, axis), 0);
    groups.add(direction, {names.direction + "_inv"}, float_irdvc(scene, axis), 0);
  }
}

/// Of two demands on a port, both of one interval, what both allow.
void add(rtl::Demands& all, const rtl::PortDemand& demand) {
  const auto known = std::find_if(all.ports.begin(), all.ports.end(),
                                  [&](const rtl::PortDemand& each) { return each.port == demand.port; });
  if (known == all.ports.end()) {
    all.ports.push_back(demand);
    return;
  }
  rtl::Interval& within = known->within.front();
  within = {std::max(within.low, demand.within.front().low),
            std::min(within.high, demand.within.front().high)};
  known->low_zeros = std::max(known->low_zeros, demand.low_zeros);
}

}  // namespace

std::vector<DemandGroup> port_demands(const rtl::Design& design, rtl::Format format,
                                      const ref::SceneDemands& scene, const Precision& precision) {
  Groups groups(design, format);
  if (design.is_float()) {
    add_float(groups, scene);
  } else {
    add_integer(groups, format.bits().coord, scene, precision);
  }
  if (!precision.ends)
    groups.add(measured_text(precision.endless_extra_box_tests_pct), {"rinf"}, rtl::Interval{1, 1}, 0);
  return groups.take();
}

rtl::Demands all_of(const std::vector<DemandGroup>& groups) {
  return all_without(groups, groups.size());
}

rtl::Demands all_without(const std::vector<DemandGroup>& groups, std::size_t left_out) {
  rtl::Demands all;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (i == left_out) continue;
    for (const rtl::PortDemand& demand : groups[i].demands.ports) add(all, demand);
    all.orders.insert(all.orders.end(), groups[i].demands.orders.begin(), groups[i].demands.orders.end());
  }
  return all;
}

}  // namespace hitpipe::sim
