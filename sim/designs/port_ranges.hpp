// Integer ranges of the ports of one axis, for all rays and boxes of a scene. Empty if nothing is known.
// Ranges of a float port, as patterns of its format: numbers without and with a sign are two intervals.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "hls/box/fp_format.hpp"
#include "hls/box/int_format.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rtl_gen/prune/demands.hpp"
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

class FloatRange {
 public:
  explicit FloatRange(const hls::FpBits& bits) : bits_(bits) {}

  /// Adds the numbers from low to high, which are numbers of the format. -0 is less than +0.
  void add(float low, float high);
  /// Ascending, as a demand lists them.
  [[nodiscard]] std::vector<rtl::Interval> within() const;

 private:
  hls::FpBits bits_;
  Range positive_, negative_;
};

/// Origins along the axis, mirrored where the direction is negative; `low` rounds them down, else up.
[[nodiscard]] std::vector<rtl::Interval> mirrored_origin(const ref::SceneDemands& scene, int axis,
                                                         const hls::FpBits& bits, bool low);
/// Lower or upper planes of boxes along the axis.
[[nodiscard]] std::vector<rtl::Interval> rounded_planes(const ref::SceneDemands& scene, int axis,
                                                        const hls::FpBits& bits, bool low);
/// Bounds of the scaled inverse direction, without their sign (fp_slabs_safe_ray.hpp).
[[nodiscard]] rtl::Interval scaled_inverse(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits,
                                           bool low);
/// 1 where the direction is negative; -0 is too.
[[nodiscard]] rtl::Interval backward(const ref::SceneDemands& scene, int axis);

}  // namespace hitpipe::sim
