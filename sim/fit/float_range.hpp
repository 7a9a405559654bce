// Ranges of a float port, as patterns of its format: numbers without and with a sign are two intervals.
#pragma once

#include <vector>

#include "hls/box/fp_format.hpp"
#include "sim/fit/port_ranges.hpp"

namespace hitpipe::sim {

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
/// Lower planes of boxes along the axis, or upper ones.
[[nodiscard]] std::vector<rtl::Interval> rounded_planes(const ref::SceneDemands& scene, int axis,
                                                        const hls::FpBits& bits, bool low);
/// Bounds of the scaled inverse direction, without their sign (fp_slabs_safe_ray.hpp).
[[nodiscard]] rtl::Interval scaled_inverse(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits,
                                           bool low);
/// 1 where the direction is negative; -0 is too.
[[nodiscard]] rtl::Interval backward(const ref::SceneDemands& scene, int axis);

}  // namespace hitpipe::sim
