#include "sim/designs/int_design.hpp"

#include <algorithm>

#include "rays/world/int_box.hpp"
#include "sim/designs/port_ranges.hpp"
#include "sw_ref/hierarchy/int_nodes.hpp"

namespace hitpipe::sim {

namespace {

using hls::IntBits;
using hls::Role;

std::optional<SceneDemand> demanded(const Range& range, int spare_bits = 0) {
  if (!range) return std::nullopt;
  return SceneDemand{{*range}, spare_bits};
}

std::optional<SceneDemand> int_demand(const rtl::Port& port, const Format& format,
                                      const ref::SceneDemands& scene, const ref::CoarseAxes& coarse) {
  // The margin of the cube leaves one bit of every coordinate unused, in every scene.
  constexpr int spare = 1;
  const int n = format.as<IntBits>().coord;
  switch (port.role) {
    case Role::origin:
      return demanded(int_origin(scene, axis_of(port), n, coarse), spare);
    case Role::plane_low:
    case Role::plane_high:
      return demanded(int_box(scene, axis_of(port), n, coarse), spare);
    case Role::direction:
      return demanded(int_direction(scene, axis_of(port), n));
    case Role::inverse_low:
    case Role::inverse_high: {
      const std::optional<IrdvcRanges> ranges = int_irdvc(scene, axis_of(port), n);
      if (!ranges) return std::nullopt;
      return SceneDemand{{port.role == Role::inverse_low ? ranges->floor : ranges->ceil}};
    }
    default:
      return std::nullopt;
  }
}

bool int_fits_coarse(const Format& format, const ref::SceneDemands& scene, const ref::CoarseAxes& coarse) {
  const int n = format.as<IntBits>().coord;
  ref::IntOrigin lowest{};
  for (int axis = 0; axis < 3; ++axis)
    lowest[static_cast<std::size_t>(axis)] = static_cast<std::int32_t>(int_origin(scene, axis, n)->low);
  return ref::fits_grid(lowest, ref::quantise_box(scene.boxes, n), coarse, n);
}

/// Groups by n; in each group sorted by t.
std::vector<std::vector<Format>> int_smaller_formats(const Format& most) {
  const auto [coord, interval] = most.as<IntBits>();
  std::vector<std::vector<Format>> groups;
  for (int n = IntBits::min_coord; n <= coord; ++n) {
    std::vector<Format>& group = groups.emplace_back();
    for (int t = IntBits::min_interval; t <= std::min(interval, IntBits{n, 0}.product()); ++t)
      group.push_back(IntBits{n, t});
  }
  return groups;
}

/// n = 8, 12, .. 32, each with t = n, n + 4, n + 8, cut to the 2n - 1 bits of a product. These include all
/// formats of Tables 6.2 to 6.7.
std::vector<Format> int_sweep_formats() {
  std::vector<Format> formats;
  for (int n = 8; n <= IntBits::max_coord; n += 4) {
    for (int t = n; t <= n + 8; t += 4) formats.push_back(IntBits{n, std::min(t, IntBits{n, t}.product())});
  }
  return formats;
}

}  // namespace

Software int_design_software() {
  return {.demand = int_demand,
          .fits_coarse = int_fits_coarse,
          .smaller_formats = int_smaller_formats,
          .sweep_formats = int_sweep_formats(),
          .stiffness_formats = {IntBits{24, 24}, IntBits{20, 24}, IntBits{16, 16}, IntBits{12, 12}},
          .fit_from = IntBits{24, 24}};
}

}  // namespace hitpipe::sim
