// Demand sets as scenes give them, for every design: what the tests, the proofs and the table of
// docs/prune.md prune by. Integer sets hold the ranges that the ports promise anyway; float sets have no such
// ranges.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "hls/box/fp_format.hpp"
#include "hls/box/major_format.hpp"
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
  for (PortDemand& each : demands.ports) {
    if (each.port == port) return each;
  }
  return demands.ports.emplace_back(PortDemand{port, {}});
}

inline void demand(Demands& demands, const std::string& port, std::vector<Interval> within) {
  demand_on(demands, port).within = std::move(within);
}

/// Float patterns.
inline constexpr std::int64_t largest_finite = 0x7f7fffff;
inline constexpr std::int64_t infinity = 0x7f800000;
inline constexpr std::int64_t minus = 0x80000000;

/// The parts of demand sets, in the words of each design.
class Scene {
 public:
  Scene(const Design& design, Format format)
      : slabs_(design.name.ends_with("slabs")),
        floats_(!design.conservative),
        bits_(floats_ ? hls::IntBits{} : format.as<hls::IntBits>()),
        grid_(std::int64_t{1} << (bits_.coord - 2)),
        demands_(set_up_demands(design.ports(format))) {}

  [[nodiscard]] Demands demands() const { return demands_; }

  Scene& infinite_rays() {
    demand(demands_, "rinf", {{1, 1}});
    return *this;
  }
  Scene& finite_rays() {
    demand(demands_, "rinf", {{0, 0}});
    return *this;
  }
  /// All rays run towards +x, -y, +z.
  Scene& one_direction() {
    const char* const axes = "ijk";
    for (int a = 0; a < 3; ++a) {
      const bool backward = a == 1;
      for (const std::string& port : direction(axes[a])) demand(demands_, port, {one_sign(backward)});
    }
    return *this;
  }
  Scene& fixed_origin() {
    const std::int64_t float_origin[3] = {0x3e99999a, 0x3f000000, minus | 0x3dcccccd};  // 0.3, 0.5, -0.1
    const std::int64_t grid_origin[3] = {grid_ * 3 / 10, grid_ / 2, -grid_ / 10};
    for (std::size_t a = 0; a < 3; ++a) {
      const std::int64_t at = floats_ ? float_origin[a] : grid_origin[a];
      demand(demands_, prefix() + "r" + axis_[a], {{at, at}});
    }
    return *this;
  }
  /// The scene and its rays lie between two planes of constant y close to each other: floats in 0.25 .. 0.5,
  /// integers in a 64th of the grid.
  Scene& narrow_axis() {
    const Interval within = floats_ ? Interval{0x3e800000, 0x3f000000} : Interval{-(grid_ / 64), grid_ / 64};
    for (const char* const port : {"ry", "ymin", "ymax"}) demand(demands_, prefix() + port, {within});
    if (!slabs_) demand(demands_, prefix() + "rey", {within});
    return *this;
  }
  /// Origin and boxes lie on every eighth plane of constant y; a float's low three bits are 0.
  Scene& coarse_axis() {
    for (const char* const port : {"ry", "ymin", "ymax"}) {
      PortDemand& coarse = demand_on(demands_, prefix() + port);
      if (coarse.within.empty()) coarse.within = {{0, minus | 0x7fffffff}};
      coarse.low_zeros = 3;
    }
    return *this;
  }
  Scene& no_zero_components() {
    for (const char a : std::string("ijk")) {
      for (const std::string& port : direction(a)) demand(demands_, port, no_zero());
    }
    return *this;
  }
  Scene& ordered_boxes() {
    for (const std::string a : {"x", "y", "z"})
      demands_.orders.push_back({prefix() + a + "min", prefix() + a + "max"});
    return *this;
  }

 private:
  [[nodiscard]] std::string prefix() const { return floats_ ? "" : "i"; }
  [[nodiscard]] std::vector<std::string> direction(char axis) const {
    const std::string name = prefix() + "r" + axis;
    if (!slabs_) return {name};
    if (floats_) return {name + "_inv"};
    return {name + "_floor", name + "_ceil"};
  }
  [[nodiscard]] Interval one_sign(bool backward) const {
    if (floats_) return backward ? Interval{minus, minus | infinity} : Interval{0, infinity};
    return backward ? Interval{-(2 * grid_ - 1), -1} : Interval{0, 2 * grid_ - 1};
  }
  /// Of a float IRDVC: no infinity.
  [[nodiscard]] std::vector<Interval> no_zero() const {
    if (floats_ && slabs_) return {{0, largest_finite}, {minus, minus | largest_finite}};
    if (floats_) return {{1, infinity}, {minus | 1, minus | infinity}};
    return {{-(2 * grid_ - 1), -1}, {1, 2 * grid_ - 1}};
  }

  bool slabs_;
  bool floats_;
  hls::IntBits bits_;
  std::int64_t grid_;
  Demands demands_;
  const std::string axis_ = "xyz";
};

/// Of designs with a major axis: their ray is in slots, so a set speaks of slots, and of boxes by axis.
inline std::vector<DemandSet> major_demand_sets(const Design& design, Format format) {
  const auto bits = format.as<hls::MajorBits>();
  const std::int64_t grid = bits.largest_point();
  const auto upward = [](Demands& demands) {
    for (const char* const port : {"back_m", "back_a", "back_b"}) demand(demands, port, {{0, 0}});
  };
  const auto along_z = [](Demands& demands) {
    demand(demands, "major_y", {{0, 0}});
    demand(demands, "major_z", {{1, 1}});
  };
  const auto fixed_origin = [&](Demands& demands) {
    const std::int64_t fine = grid << bits.finer;
    demand(demands, "origin_m", {{fine * 3 / 10, fine * 3 / 10}});
    demand(demands, "origin_a", {{-fine / 2, -fine / 2}});  // below a narrow y
    demand(demands, "origin_b", {{-fine / 10, -fine / 10}});
  };
  const auto narrow = [&](Demands& demands) {
    for (const char* const port : {"ymin", "ymax"}) demand(demands, port, {{-(grid / 64), grid / 64}});
  };
  const auto coarse = [](Demands& demands) {
    for (const char* const port : {"ymin", "ymax"}) demand_on(demands, port).low_zeros = 3;
  };
  const auto no_zero = [&](Demands& demands) {
    for (const char* const port : {"exp_a", "exp_b"})
      demand(demands, port, {{0, bits.largest_exponent() - 1}});
  };
  const auto ordered = [](Demands& demands) {
    for (const std::string a : {"x", "y", "z"}) demands.orders.push_back({a + "min", a + "max"});
  };
  const auto with = [&](const auto&... parts) {
    Demands demands = set_up_demands(design.ports(format));
    (parts(demands), ...);
    return demands;
  };
  return {{"upward", with(upward)},
          {"one major axis", with(along_z)},
          {"fixed origin", with(fixed_origin)},
          {"narrow y", with(narrow)},
          {"coarse y", with(coarse)},
          {"no zero component", with(no_zero)},
          {"min <= max", with(ordered)},
          {"all of these", with(upward, along_z, fixed_origin, narrow, coarse, no_zero, ordered)}};
}

/// Of float designs whose ray is mirrored, with a port for the sign of each direction component.
inline std::vector<DemandSet> any_float_demand_sets(const Design& design, Format format) {
  const auto bits = format.as<hls::FpBits>();
  const std::int64_t quarter = bits.one() - (std::int64_t{2} << bits.fraction);
  const auto upward = [](Demands& demands) {
    for (const char* const port : {"back_x", "back_y", "back_z"}) demand(demands, port, {{0, 0}});
  };
  const auto fixed_origin = [&](Demands& demands) {
    for (const char* const port : {"rx", "ry", "rz"}) demand(demands, port, {{quarter, quarter}});
  };
  const auto narrow = [&](Demands& demands) {
    const Interval half = {quarter, quarter + (std::int64_t{1} << bits.fraction)};
    for (const char* const port : {"ry", "ymin", "ymax"}) demand(demands, port, {half});
  };
  const auto coarse = [&](Demands& demands) {
    for (const char* const port : {"ymin", "ymax"}) {
      PortDemand& demanded = demand_on(demands, port);
      if (demanded.within.empty()) demanded.within = {{0, (std::int64_t{1} << bits.width()) - 1}};
      demanded.low_zeros = 3;
    }
  };
  const auto no_zero = [&](Demands& demands) {
    for (const char* const port : {"ri_high", "rj_high", "rk_high"})
      demand(demands, port, {{bits.one(), bits.infinity() - 1}});
  };
  const auto with = [&](const auto&... parts) {
    Demands demands = set_up_demands(design.ports(format));
    (parts(demands), ...);
    return demands;
  };
  const auto ends = [](std::int64_t rinf) {
    return [rinf](Demands& demands) { demand(demands, "rinf", {{rinf, rinf}}); };
  };
  return {{"infinite rays", with(ends(1))},
          {"finite rays", with(ends(0))},
          {"upward", with(upward)},
          {"fixed origin", with(fixed_origin)},
          {"narrow y", with(narrow)},
          {"coarse y", with(coarse)},
          {"no zero component", with(no_zero)},
          {"all of these", with(ends(1), upward, fixed_origin, narrow, coarse, no_zero)}};
}

inline std::vector<DemandSet> demand_sets(const Design& design, Format format) {
  if (format.is<hls::FpBits>()) return any_float_demand_sets(design, format);
  if (format.is<hls::MajorBits>()) return major_demand_sets(design, format);
  const auto scene = [&] { return Scene(design, format); };
  Scene all = scene();  // the camera stands outside the slab
  all.infinite_rays().one_direction().narrow_axis().coarse_axis().fixed_origin().ordered_boxes();
  return {{"infinite rays", scene().infinite_rays().demands()},
          {"finite rays", scene().finite_rays().demands()},
          {"one direction class", scene().one_direction().demands()},
          {"fixed origin", scene().fixed_origin().demands()},
          {"narrow y", scene().narrow_axis().demands()},
          {"coarse y", scene().coarse_axis().demands()},
          {"no zero component", scene().no_zero_components().demands()},
          {"min <= max", scene().ordered_boxes().demands()},
          {"all of these", all.demands()}};
}

/// The operands of the ports that a pruned graph still has, in its order.
inline std::vector<std::uint64_t> operands_left(const Graph& pruned, const std::vector<Port>& ports,
                                                const std::vector<std::int64_t>& operands) {
  std::vector<std::uint64_t> left;
  for (const NodeId id : pruned.inputs()) {
    for (std::size_t i = 0; i < ports.size(); ++i) {
      if (ports[i].name == pruned[id].name) left.push_back(static_cast<std::uint64_t>(operands[i]));
    }
  }
  return left;
}

}  // namespace hitpipe::rtl
