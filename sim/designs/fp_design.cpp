#include "sim/designs/fp_design.hpp"

#include "sim/designs/port_ranges.hpp"

namespace hitpipe::sim {

namespace {

using hls::Role;

std::optional<SceneDemand> fp_demand(const rtl::Port& port, const Format& /*binary32*/,
                                     const ref::SceneDemands& scene, const ref::CoarseAxes& /*none*/) {
  const int axis = rtl::axis_of(port);
  Range range;
  switch (port.role) {
    case Role::origin:
      range = float_range(scene.origins().min[axis], scene.origins().max[axis]);
      break;
    case Role::plane_low:
    case Role::plane_high:
      range = float_range(scene.boxes.min[axis], scene.boxes.max[axis]);
      break;
    case Role::direction:
      range = float_direction(scene, axis);
      break;
    case Role::inverse:
      range = float_irdvc(scene, axis);
      break;
    default:
      break;
  }
  if (!range) return std::nullopt;
  return SceneDemand{{*range}};
}

}  // namespace

Software fp_design_software() {
  return {.demand = fp_demand,
          .sweep_formats = {hls::Binary32{}},
          .stiffness_formats = {hls::Binary32{}},
          .fit_from = hls::Binary32{}};
}

}  // namespace hitpipe::sim
