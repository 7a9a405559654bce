// The box test of the unit with a major axis (docs/never_misses.md) in 64-bit words, for any format chosen at run
// time. It gives the same HIT as the datapath of hls/pipelines/int_major.hpp. It takes boxes of the n-bit
// grid, grown for the finer origin, and is a SoftwareBoxTest (sw_ref/trace/traversal.hpp).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "hls/box/major_format.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/test_maker.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_major_ray.hpp"

namespace hitpipe::ref {

/// The distances of one ray to planes, in units of 2^-F of their grid.
class MajorDistances {
 public:
  /// `ray` is set up for this format. In a format of the integer world it is ref::major_ray(). With slack, by ray axis
  /// and in units of the origin's grid, near planes are seen from so far ahead and far ones from so far behind.
  MajorDistances(const IntMajorRay& ray, const hls::MajorBits& bits,
                 const std::array<std::int64_t, 3>& slack = {});

  /// Of the lower and upper plane of ray axis m, a or b.
  [[nodiscard]] RayInterval slab(std::size_t ray_axis, const IntBox& box) const {
    const RayAxis& s = ray_axes_[ray_axis];
    const std::int64_t low = (std::int64_t{box.min[s.axis]} << finer_) ^ s.mirror;
    const std::int64_t high = (std::int64_t{box.max[s.axis]} << finer_) ^ s.mirror;
    const std::int64_t d_near = (s.mirror < 0 ? high : low) + s.minus_near;
    const std::int64_t d_far = (s.mirror < 0 ? low : high) + s.minus_far + carry_;
    if (ray_axis == 0) return {trimmed(d_near, 0), trimmed(d_far, 0)};
    const std::int64_t near = shifted(d_near, s.exponent) * (d_near < 0 ? s.ceil : s.floor);
    const std::int64_t far = shifted(d_far, s.exponent) * (d_far < 0 ? s.floor : s.ceil);
    return {trimmed(near, mantissa_), trimmed(far, mantissa_)};
  }
  /// The three intervals and [0, length] have a point in common.
  [[nodiscard]] bool meets(const IntBox& box, std::int64_t length) const {
    // Starting at 0 and at the length is the same as comparing with them afterwards.
    RayInterval all{0, length};
    for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
      const RayInterval t = slab(ray_axis, box);
      all.near = std::max(all.near, t.near);
      all.far = std::min(all.far, t.far);
    }
    return all.near <= all.far;
  }
  /// Which axis a ray axis is, and whether the ray goes down it.
  [[nodiscard]] std::size_t axis(std::size_t ray_axis) const { return ray_axes_[ray_axis].axis; }
  [[nodiscard]] bool backward(std::size_t ray_axis) const { return ray_axes_[ray_axis].mirror < 0; }

 private:
  struct RayAxis {
    std::size_t axis;
    std::int64_t mirror;                 ///< -1: backward, else 0
    std::int64_t minus_near, minus_far;  ///< the negated origins
    std::int64_t floor, ceil;
    int exponent;
  };

  /// d 2^exponent, saturated as in the datapath.
  [[nodiscard]] std::int64_t shifted(std::int64_t d, int exponent) const {
    return std::clamp(d, least_ >> exponent, most_ >> exponent) == d ? d * (std::int64_t{1} << exponent)
                                                                     : (d < 0 ? least_ : most_);
  }
  /// Without bits below the fraction; `bits` more of them are a mantissa's.
  [[nodiscard]] std::int64_t trimmed(std::int64_t x, int bits) const {
    const int below = finer_ - fraction_ + bits;
    return below >= 0 ? x >> below : x * (std::int64_t{1} << -below);
  }

  std::array<RayAxis, 3> ray_axes_{};
  int finer_, fraction_;
  int mantissa_;  ///< p - 1
  int carry_;     ///< 1 in the integer world
  std::int64_t least_, most_;
};

class IntMajorTest {
 public:
  /// Throws as IntMajorRaySetup does.
  IntMajorTest(const Ray& ray, hls::MajorBits bits) : set_up_(ray, bits), distances_(set_up_.ray(), bits) {
    cut(ray.length);
  }

  /// `length` must be >= 0 or infinite.
  void cut(float length) { length_ = set_up_.length(length); }

  [[nodiscard]] bool operator()(const IntBox& box) const { return distances_.meets(box, length_); }

 private:
  IntMajorRaySetup set_up_;
  MajorDistances distances_;
  std::int64_t length_ = 0;
};

using IntMajorTestMaker = TestMaker<IntMajorTest, hls::MajorBits>;

}  // namespace hitpipe::ref
