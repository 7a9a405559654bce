// Integer ranges of the ports of one axis, for all rays and boxes of a scene. Empty if nothing is known.
#pragma once

#include <array>
#include <optional>

#include "hls/box/int_format.hpp"
#include "rtl_gen/prune/demands.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/quantise/scene_demands.hpp"

namespace hitpipe::sim {

using Range = std::optional<rtl::Interval>;
/// The smallest range that holds both.
void grow(Range& range, const rtl::Interval& by);

/// Bounds of the magnitudes of a family's direction components, by axis.
struct Magnitudes {
  std::array<double, 3> least{};
  std::array<double, 3> most{};

  explicit Magnitudes(const ref::Aabb& direction);
};

/// Grid coordinates of ray origins, and of both corners of boxes. `coarse` must fit the scene.
[[nodiscard]] Range int_origin(const ref::SceneDemands& scene, int axis, int coord_bits,
                               const ref::CoarseAxes& coarse = {});
[[nodiscard]] Range int_box(const ref::SceneDemands& scene, int axis, int coord_bits,
                            const ref::CoarseAxes& coarse = {});
/// Bounds of the scaled inverse direction (int_slabs_ray.hpp). Only if no direction may be 0 along the axis.
struct IrdvcRanges {
  rtl::Interval floor;
  rtl::Interval ceil;
};
[[nodiscard]] std::optional<IrdvcRanges> int_irdvc(const ref::SceneDemands& scene, int axis, int coord_bits);
/// The rounded direction (int_plucker_ray.hpp).
[[nodiscard]] Range int_direction(const ref::SceneDemands& scene, int axis, int coord_bits);

/// Patterns of the binary32 numbers from one to another of the same sign, 0 excluded, or of a single number.
[[nodiscard]] Range float_range(float low, float high);
/// The same for the directions along the axis, and for their reciprocals.
[[nodiscard]] Range float_direction(const ref::SceneDemands& scene, int axis);
[[nodiscard]] Range float_irdvc(const ref::SceneDemands& scene, int axis);

}  // namespace hitpipe::sim
