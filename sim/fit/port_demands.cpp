#include "sim/fit/port_demands.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <initializer_list>
#include <stdexcept>

#include <fmt/format.h>

#include "rtl_gen/prune/facts.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim {

namespace {

using hls::Axis;
using hls::Role;

bool one_of(Role role, std::initializer_list<Role> roles) {
  return std::find(roles.begin(), roles.end(), role) != roles.end();
}

constexpr std::initializer_list<Role> origin_roles{Role::origin, Role::origin_high};
constexpr std::initializer_list<Role> box_roles{Role::plane_low, Role::plane_high};
constexpr std::initializer_list<Role> direction_roles{Role::direction,    Role::inverse,  Role::inverse_low,
                                                      Role::inverse_high, Role::exponent, Role::backward,
                                                      Role::major};

class Groups {
 public:
  Groups(const rtl::Design& design, const Format& format, const ref::SceneDemands& scene,
         const ref::CoarseAxes& coarse)
      : ports_(design.ports(format)),
        demand_(software_of(design).demand),
        format_(format),
        scene_(scene),
        coarse_(coarse) {
    if (demand_ == nullptr) throw std::runtime_error(missing(design, demand_part));
  }

  /// What the scene says of the axis's ports with these roles. Only ports that lose more than the spare bits
  /// that no scene uses.
  void add(const std::string& why, Axis axis, const std::initializer_list<Role>& roles) {
    rtl::Demands demands;
    for (const rtl::Port& port : ports_) {
      if (port.axis != axis || !one_of(port.role, roles)) continue;
      const std::optional<SceneDemand> demand = demand_(port, format_, scene_, coarse_);
      if (demand && loses_bits(port, *demand)) demands.ports.push_back({port.name, demand->within});
    }
    keep({why, DemandGroup::What::numbers, std::move(demands)});
  }
  /// The low bits of origin and box that are 0 on the axis.
  void add_low_zeros(const std::string& why, Axis axis, int low_zeros) {
    rtl::Demands demands;
    for (const rtl::Port& port : ports_) {
      if (port.axis == axis && (one_of(port.role, origin_roles) || one_of(port.role, box_roles)))
        demands.ports.push_back({port.name, {rtl::all_numbers(port)}, low_zeros});
    }
    keep({why, DemandGroup::What::low_bits, std::move(demands)});
  }
  /// No ray has an end.
  void add_endless(const std::string& why) {
    rtl::Demands demands;
    for (const rtl::Port& port : ports_)
      if (port.role == Role::endless) demands.ports.push_back({port.name, {{1, 1}}});
    keep({why, DemandGroup::What::ends, std::move(demands)});
  }
  [[nodiscard]] std::vector<DemandGroup> take() { return std::move(groups_); }

 private:
  void keep(DemandGroup group) {
    if (group.demands.empty()) return;
    groups_.push_back(std::move(group));
  }
  static bool loses_bits(const rtl::Port& port, const SceneDemand& demand) {
    const rtl::Facts facts = rtl::facts_of({port.name, demand.within}, port.width, port.is_signed);
    if (port.kind == hls::Kind::real)
      return rtl::count_of_ones(facts.zeros() | facts.ones()) > demand.spare_bits;
    if (!port.is_signed) return facts.is_constant() || facts.unknown_width() < port.width - demand.spare_bits;
    return facts.number().low >= 0 || facts.number().high < 0 ||
           facts.signed_width() < port.width - demand.spare_bits;
  }

  std::vector<rtl::Port> ports_;
  decltype(Software::demand) demand_;
  Format format_;
  const ref::SceneDemands& scene_;
  const ref::CoarseAxes coarse_;
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

constexpr std::array<Axis, 3> all_axes{Axis::x, Axis::y, Axis::z};

/// What lies in an interval of each list. Both ascend.
std::vector<rtl::Interval> in_both(const std::vector<rtl::Interval>& a, const std::vector<rtl::Interval>& b) {
  std::vector<rtl::Interval> both;
  for (const rtl::Interval& one : a) {
    for (const rtl::Interval& other : b) {
      const rtl::Interval within{std::max(one.low, other.low), std::min(one.high, other.high)};
      if (within.low <= within.high) both.push_back(within);
    }
  }
  return both;
}

/// What two demands on one port both allow.
void add(rtl::Demands& all, const rtl::PortDemand& demand) {
  const auto known = std::find_if(all.ports.begin(), all.ports.end(),
                                  [&](const rtl::PortDemand& each) { return each.port == demand.port; });
  if (known == all.ports.end()) {
    all.ports.push_back(demand);
    return;
  }
  known->within = in_both(known->within, demand.within);
  known->low_zeros = std::max(known->low_zeros, demand.low_zeros);
}

}  // namespace

std::vector<DemandGroup> port_demands(const rtl::Design& design, const Format& format,
                                      const ref::SceneDemands& scene,
                                      const std::optional<Precision>& precision) {
  const ref::CoarseAxes coarse = precision ? precision->coarse : ref::CoarseAxes{};
  Groups groups(design, format, scene, coarse);
  const ref::Aabb origins = scene.origins();
  for (int i = 0; i < 3; ++i) {
    const Axis axis = all_axes[static_cast<std::size_t>(i)];
    groups.add(bounds("ray origin", i, origins.min[i], origins.max[i]), axis, origin_roles);
    groups.add(bounds("box", i, scene.boxes.min[i], scene.boxes.max[i]), axis, box_roles);
    groups.add(direction_text(scene, i), axis, direction_roles);
  }
  // Operands that belong to an axis of each ray's own.
  groups.add("ray origins of all axes", Axis::none, origin_roles);
  groups.add("directions of all axes", Axis::none, direction_roles);
  for (std::size_t i = 0; i < 3; ++i) {
    if (const int dropped = coarse.dropped[i]; dropped > 0)
      groups.add_low_zeros(measured_text(precision->coarse_extra_box_tests_pct), all_axes[i], dropped);
  }
  if (precision && !precision->ends)
    groups.add_endless(measured_text(*precision->endless_extra_box_tests_pct));
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
