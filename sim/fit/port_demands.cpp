#include "sim/fit/port_demands.hpp"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "rtl_gen/prune/facts.hpp"
#include "sim/fit/port_ranges.hpp"

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

/// Names of the axis' ports, without the i of integers.
struct PortNames {
  std::string origin, direction, low, high;
};
PortNames names_of(int axis) {
  const std::string x(1, "xyz"[axis]);
  return {"r" + x, std::string("r") + "ijk"[axis], x + "min", x + "max"};
}

std::string bounds(const char* what, int axis, float low, float high) {
  return low == high ? fmt::format("{}.{} is always {:.6g}", what, "xyz"[axis], low)
                     : fmt::format("{}.{} lies within {:.6g} .. {:.6g}", what, "xyz"[axis], low, high);
}

std::string direction_text(const ref::SceneDemands& scene, int axis) {
  ref::Aabb all;
  for (const ref::RayFamily& family : scene.rays) all.grow(family.direction);
  return bounds("direction", axis, all.min[axis], all.max[axis]);
}

void add_integer(Groups& groups, int coord_bits, const ref::SceneDemands& scene) {
  // The cube's margin leaves one bit of every coordinate unused, in every scene.
  constexpr int spare = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const PortNames names = names_of(axis);
    const ref::Aabb origins = scene.origins();
    groups.add(bounds("ray origin", axis, origins.min[axis], origins.max[axis]), {"i" + names.origin},
               int_origin(scene, axis, coord_bits), spare);
    groups.add(bounds("box", axis, scene.boxes.min[axis], scene.boxes.max[axis]),
               {"i" + names.low, "i" + names.high}, int_box(scene, axis, coord_bits), spare);
    const std::string direction = direction_text(scene, axis);
    if (const auto irdvc = int_irdvc(scene, axis, coord_bits)) {
      groups.add(direction, {"i" + names.direction + "_floor"}, irdvc->floor, 0);
      groups.add(direction, {"i" + names.direction + "_ceil"}, irdvc->ceil, 0);
    }
    groups.add(direction, {"i" + names.direction}, int_direction(scene, axis, coord_bits), 0);
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

}  // namespace

std::vector<DemandGroup> port_demands(const rtl::Design& design, rtl::Format format,
                                      const ref::SceneDemands& scene) {
  Groups groups(design, format);
  if (design.is_float()) {
    add_float(groups, scene);
  } else {
    add_integer(groups, format.bits().coord, scene);
  }
  return groups.take();
}

rtl::Demands all_of(const std::vector<DemandGroup>& groups) {
  return all_without(groups, groups.size());
}

rtl::Demands all_without(const std::vector<DemandGroup>& groups, std::size_t left_out) {
  rtl::Demands all;
  for (std::size_t i = 0; i < groups.size(); ++i) {
    if (i == left_out) continue;
    all.ports.insert(all.ports.end(), groups[i].demands.ports.begin(), groups[i].demands.ports.end());
    all.orders.insert(all.orders.end(), groups[i].demands.orders.begin(), groups[i].demands.orders.end());
  }
  return all;
}

}  // namespace hitpipe::sim
