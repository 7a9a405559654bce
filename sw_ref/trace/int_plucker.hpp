// The integer Pluecker box test (section 6.3.2) in 64-bit words, for any n/t chosen at run time. It gives the
// same HIT as the datapath of hls/pipelines/int_plucker.hpp. It takes boxes of the n-bit grid
// (rays/world/int_box.hpp), and is a SoftwareBoxTest (sw_ref/trace/traversal.hpp).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hls/box/int_format.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/test_maker.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rays/world/int_box.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"

namespace hitpipe::ref {

/// Differences and directions have n - 1 bits and a sign, and n <= 32, so products stay below 2^62.
class IntPluckerTest {
 public:
  static constexpr const char* maker_name = "IntPluckerTestMaker";

  /// Throws as IntPluckerRaySetup and coarse_origin() do.
  IntPluckerTest(const Ray& ray, hls::IntBits bits, const CoarseAxes& coarse = {});

  /// `length` must be >= 0 or infinite.
  void cut(float length);

  [[nodiscard]] bool operator()(const IntBox& box) const {
    if (!reaches(0, box) || !reaches(1, box) || !reaches(2, box)) return false;
    const View x = view(0, box);
    const View y = view(1, box);
    const View z = view(2, box);
    return inside(x, y) && inside(z, x) && inside(y, z);
  }

 private:
  struct Axis {
    std::int64_t origin, direction;
    std::int64_t end;  ///< beyond every plane if the ray has no end in the cube
    bool minus;        ///< the class of the rounded direction is minus
  };

  /// An axis as seen from the ray: the direction, and the planes minus the origin.
  struct View {
    std::int64_t direction, lower, upper;
    bool minus;
  };

  /// True if on this axis the box is neither behind the origin nor beyond the end.
  [[nodiscard]] bool reaches(std::size_t i, const IntBox& box) const {
    const Axis& axis = axes_[i];
    const std::int64_t first = axis.minus ? axis.end : axis.origin;
    const std::int64_t last = axis.minus ? axis.origin : axis.end;
    return first <= box.max[i] && box.min[i] <= last;
  }

  [[nodiscard]] View view(std::size_t i, const IntBox& box) const {
    const Axis& axis = axes_[i];
    return {axis.direction, box.min[i] - axis.origin, box.max[i] - axis.origin, axis.minus};
  }

  [[nodiscard]] std::int64_t term(std::int64_t direction, std::int64_t plane) const {
    return direction * plane >> trimmed_;
  }

  /// True if the ray passes on the inner side of both silhouette edges that are parallel to the third axis.
  [[nodiscard]] bool inside(const View& i, const View& j) const {
    const std::int64_t first =
        term(j.direction, j.minus ? i.lower : i.upper) - term(i.direction, i.minus ? j.upper : j.lower);
    const std::int64_t second =
        term(i.direction, i.minus ? j.lower : j.upper) - term(j.direction, j.minus ? i.upper : i.lower);
    return first >= edge_bound_ && second >= edge_bound_;
  }

  void set_end(const IntEndpoint& end);

  IntPluckerRaySetup set_up_;
  std::array<Axis, 3> axes_{};
  int trimmed_;
  std::int64_t edge_bound_;
};

using IntPluckerTestMaker = IntTestMaker<IntPluckerTest>;

}  // namespace hitpipe::ref
