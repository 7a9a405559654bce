// Demand sets as scenes give them, for every design: what the tests, the proofs and the table of
// docs/fit.md prune by. Integer sets hold the ranges that the ports promise anyway; float sets have no such
// ranges.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "hls/box/fp_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "rtl_gen/prune/draw.hpp"
#include "tests/rtl_gen/seeded.hpp"

namespace hitpipe::rtl {

struct DemandSet {
  std::string name;
  Demands demands;
};

/// The demand on the port: the one that is there, or a new one without intervals.
inline PortDemand& demand_on(Demands& demands, const std::string& port) {
  for (PortDemand& each : demands.ports)
    if (each.port == port) return each;
  return demands.ports.emplace_back(PortDemand{port, {}});
}

inline void demand(Demands& demands, const std::string& port, std::vector<Interval> within) {
  demand_on(demands, port).within = std::move(within);
}

/// Float patterns.
inline constexpr std::int64_t largest_finite = 0x7f7fffff;
inline constexpr std::int64_t infinity = 0x7f800000;
inline constexpr std::int64_t minus = 0x80000000;

/// The parts of demand sets. Ports are found by role and axis; a part demands nothing where there is no such
/// port.
class Scene {
 public:
  Scene(const Design& design, Format format)
      : ports_(design.ports(format)), demands_(set_up_demands(ports_)) {}

  [[nodiscard]] Demands demands() const { return demands_; }
  /// The ports with the first role, then the ports with the next, of all axes or of one.
  [[nodiscard]] std::vector<Port> with(std::initializer_list<hls::Role> roles,
                                       std::optional<hls::Axis> axis = std::nullopt) const {
    std::vector<Port> found;
    for (const hls::Role role : roles)
      std::copy_if(ports_.begin(), ports_.end(), std::back_inserter(found), [&](const Port& port) {
        return port.role == role && port.box == 0 && (!axis || port.axis == *axis);
      });
    return found;
  }
  [[nodiscard]] bool has(hls::Role role) const { return !with({role}).empty(); }

  Scene& infinite_rays() { return flags(hls::Role::endless, 1); }
  Scene& finite_rays() { return flags(hls::Role::endless, 0); }
  /// All rays run towards +x, -y, +z.
  Scene& one_direction() {
    for (const Port& port : with(directions)) {
      const bool backward = port.axis == hls::Axis::y;
      if (is_float(port))
        demand(demands_, port.name, {backward ? Interval{minus, minus | infinity} : Interval{0, infinity}});
      else
        demand(demands_, port.name,
               {backward ? Interval{port.range->low, -1} : Interval{0, port.range->high}});
    }
    return *this;
  }
  /// The same for rays that are mirrored: all run towards +x, +y, +z.
  Scene& upward() { return flags(hls::Role::backward, 0); }
  Scene& fixed_origin() {
    const std::int64_t pattern[3] = {0x3e99999a, 0x3f000000, minus | 0x3dcccccd};  // 0.3, 0.5, -0.1
    std::size_t i = 0;
    for (const Port& port : with({hls::Role::origin})) {
      const std::int64_t grid = grid_of(port);
      const std::int64_t on_grid[3] = {grid * 3 / 10, grid / 2, -grid / 10};
      const std::int64_t at = is_float(port) ? pattern[i] : on_grid[i];
      demand(demands_, port.name, {{at, at}});
      ++i;
    }
    return *this;
  }
  /// The scene and its rays lie between two planes of constant y close to each other: floats in 0.25 .. 0.5,
  /// integers in a 64th of the grid.
  Scene& narrow_axis() {
    for (const Port& port :
         with({hls::Role::origin, hls::Role::plane_low, hls::Role::plane_high, hls::Role::endpoint},
              hls::Axis::y)) {
      const std::int64_t least = grid_of(port) / 64;
      demand(demands_, port.name,
             {is_float(port) ? Interval{0x3e800000, 0x3f000000} : Interval{-least, least}});
    }
    return *this;
  }
  /// Origin and boxes lie on every eighth plane of constant y; a float's low three bits are 0.
  Scene& coarse_axis() {
    for (const Port& port :
         with({hls::Role::origin, hls::Role::plane_low, hls::Role::plane_high}, hls::Axis::y))
      coarse(port);
    return *this;
  }
  /// Boxes alone lie on such planes.
  Scene& coarse_planes() {
    for (const Port& plane : with({hls::Role::plane_low, hls::Role::plane_high}, hls::Axis::y)) coarse(plane);
    return *this;
  }
  Scene& no_zero_components() {
    for (const Port& port : with(directions)) {
      std::vector<Interval> within{{port.range->low, -1}, {1, port.range->high}};
      // Of a float reciprocal: no infinity.
      if (is_float(port) && port.role == hls::Role::direction)
        within = {{1, infinity}, {minus | 1, minus | infinity}};
      else if (is_float(port))
        within = {{0, largest_finite}, {minus, minus | largest_finite}};
      demand(demands_, port.name, within);
    }
    return *this;
  }
  Scene& ordered_boxes() {
    for (const hls::Axis axis : {hls::Axis::x, hls::Axis::y, hls::Axis::z}) {
      const std::vector<Port> low = with({hls::Role::plane_low}, axis);
      const std::vector<Port> high = with({hls::Role::plane_high}, axis);
      if (!low.empty() && !high.empty()) demands_.orders.push_back({low.front().name, high.front().name});
    }
    return *this;
  }

  Scene& flags(hls::Role role, std::int64_t value, std::optional<hls::Axis> axis = std::nullopt) {
    for (const Port& port : with({role}, axis)) demand(demands_, port.name, {{value, value}});
    return *this;
  }
  Scene& within(const std::vector<Port>& ports, const Interval& numbers) {
    for (const Port& port : ports) demand(demands_, port.name, {numbers});
    return *this;
  }
  Scene& coarse(const Port& port) {
    PortDemand& coarse = demand_on(demands_, port.name);
    if (coarse.within.empty()) coarse.within = {*port.range};
    coarse.low_zeros = 3;
    return *this;
  }

  static constexpr std::initializer_list<hls::Role> directions{
      hls::Role::direction, hls::Role::inverse, hls::Role::inverse_low, hls::Role::inverse_high};

 private:
  [[nodiscard]] static bool is_float(const Port& port) { return port.kind == hls::Kind::real; }
  /// Numbers of the port are in -grid..grid.
  [[nodiscard]] static std::int64_t grid_of(const Port& port) {
    return static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(port.range->high)));
  }

  std::vector<Port> ports_;
  Demands demands_;
};

/// A part of a demand set, which is a set by itself. The set "all of these" has the parts with a place in it,
/// in the order of their places: a later part replaces what an earlier one demands of a port.
struct ScenePart {
  std::string name;
  int place;  ///< from 1; 0: none
  std::function<void(Scene&)> add;
};

inline std::vector<DemandSet> sets_of(const Design& design, Format format,
                                      const std::vector<ScenePart>& parts) {
  std::vector<DemandSet> sets;
  for (const ScenePart& part : parts) {
    Scene alone(design, format);
    part.add(alone);
    sets.push_back({part.name, alone.demands()});
  }
  Scene all(design, format);
  for (int place = 1; place <= std::ssize(parts); ++place)
    for (const ScenePart& part : parts)
      if (part.place == place) part.add(all);
  sets.push_back({"all of these", all.demands()});
  return sets;
}

/// Of designs with a major axis: their ray is in lanes, of which only the boxes have an axis.
inline std::vector<DemandSet> major_demand_sets(const Design& design, Format format) {
  using hls::Axis;
  using hls::Role;
  const auto fixed_origin = [](Scene& all) {
    const std::vector<Port> origins = all.with({Role::origin});
    if (origins.empty()) return;
    const std::int64_t fine = origins[0].range->high;
    const std::int64_t at[3] = {fine * 3 / 10, -fine / 2, -fine / 10};  // the second is below a narrow y
    for (std::size_t i = 0; i < 3; ++i) all.within({origins[i]}, {at[i], at[i]});
  };
  const auto narrow = [](Scene& all) {
    const std::vector<Port> planes = all.with({Role::plane_low, Role::plane_high}, Axis::y);
    if (planes.empty()) return;
    const std::int64_t least = (planes[0].range->high - 1) / 64;
    all.within(planes, {-least, least});
  };
  const auto no_zero = [](Scene& all) {
    const std::vector<Port> exponents = all.with({Role::exponent});
    if (exponents.empty()) return;
    all.within(exponents, {0, exponents[0].range->high - 1});
  };
  return sets_of(design, format,
                 {{"upward", 1, &Scene::upward},
                  {"one major axis", 2,
                   [](Scene& all) { all.flags(Role::major, 0, Axis::y).flags(Role::major, 1, Axis::z); }},
                  {"fixed origin", 3, fixed_origin},
                  {"narrow y", 4, narrow},
                  {"coarse y", 5, &Scene::coarse_planes},
                  {"no zero component", 6, no_zero},
                  {"min <= max", 7, &Scene::ordered_boxes}});
}

/// Of float designs whose ray is mirrored, with a port for the sign of each direction component.
inline std::vector<DemandSet> any_float_demand_sets(const Design& design, Format format) {
  using hls::Role;
  const auto bits = format.as<hls::FpBits>();
  const std::int64_t quarter = bits.one() - (std::int64_t{2} << bits.fraction);
  const auto fixed_origin = [&](Scene& all) { all.within(all.with({Role::origin}), {quarter, quarter}); };
  const auto narrow = [&](Scene& all) {
    all.within(all.with({Role::origin, Role::plane_low, Role::plane_high}, hls::Axis::y),
               {quarter, quarter + (std::int64_t{1} << bits.fraction)});
  };
  const auto no_zero = [&](Scene& all) {
    all.within(all.with({Role::inverse_high}), {bits.one(), bits.infinity() - 1});
  };
  return sets_of(design, format,
                 {{"infinite rays", 1, &Scene::infinite_rays},
                  {"finite rays", 0, &Scene::finite_rays},
                  {"upward", 2, &Scene::upward},
                  {"fixed origin", 3, fixed_origin},
                  {"narrow y", 4, narrow},
                  {"coarse y", 5, &Scene::coarse_planes},
                  {"no zero component", 6, no_zero}});
}

inline std::vector<DemandSet> demand_sets(const Design& design, Format format) {
  const Scene scene(design, format);
  if (scene.has(hls::Role::major)) return major_demand_sets(design, format);
  if (scene.has(hls::Role::backward)) return any_float_demand_sets(design, format);
  std::vector<ScenePart> parts;
  if (scene.has(hls::Role::endless))
    parts = {{"infinite rays", 1, &Scene::infinite_rays}, {"finite rays", 0, &Scene::finite_rays}};
  parts.insert(parts.end(), {{"one direction class", 2, &Scene::one_direction},
                             {"fixed origin", 5, &Scene::fixed_origin},  // the camera stands outside the slab
                             {"narrow y", 3, &Scene::narrow_axis},
                             {"coarse y", 4, &Scene::coarse_axis},
                             {"no zero component", 0, &Scene::no_zero_components},
                             {"min <= max", 6, &Scene::ordered_boxes}});
  return sets_of(design, format, parts);
}

/// The operands of the ports that a pruned graph still has, in its order.
inline std::vector<std::uint64_t> operands_left(const Graph& pruned, const std::vector<Port>& ports,
                                                const std::vector<std::int64_t>& operands) {
  std::vector<std::uint64_t> left;
  for (const NodeId id : pruned.inputs()) {
    for (std::size_t i = 0; i < ports.size(); ++i)
      if (ports[i].name == pruned[id].name) left.push_back(static_cast<std::uint64_t>(operands[i]));
  }
  return left;
}

}  // namespace hitpipe::rtl
