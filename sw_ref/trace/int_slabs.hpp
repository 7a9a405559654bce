// The integer slabs box test (section 6.2.2) in 64-bit words, for any n/t chosen at run time. It gives the
// same HIT as the datapath of hls/pipelines/int_slabs.hpp. It takes boxes of the n-bit grid
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
#include "sw_ref/quantise/int_slabs_ray.hpp"

namespace hitpipe::ref {

/// Differences and IRDVCs have n - 1 bits and a sign, and n <= 32, so products stay below 2^62.
class IntSlabsTest {
 public:
  static constexpr const char* maker_name = "IntSlabsTestMaker";

  /// Throws as IntSlabsRaySetup and coarse_origin() do.
  IntSlabsTest(const Ray& ray, hls::IntBits bits, const CoarseAxes& coarse = {});

  /// `length` must be >= 0 or infinite.
  void cut(float length);

  [[nodiscard]] bool operator()(const IntBox& box) const {
    // Starting at 0 changes nothing: near > length >= 0 and near > far >= 0 are misses either way.
    std::int64_t near = 0;
    std::int64_t far = length_;
    for (std::size_t i = 0; i < 3; ++i) {
      const Axis& axis = axes_[i];
      const std::int64_t d0 = std::int64_t{box.min[i]} - axis.origin;
      const std::int64_t d1 = std::int64_t{box.max[i]} - axis.origin;
      const std::int64_t d_near = axis.backward ? d1 : d0;
      const std::int64_t d_far = axis.backward ? d0 : d1;
      const std::int64_t t_near = d_near * (d_near < 0 ? axis.ceil : axis.floor) >> trimmed_;
      const std::int64_t t_far = d_far * (d_far < 0 ? axis.floor : axis.ceil) >> trimmed_;
      near = t_near > near ? t_near : near;
      far = t_far < far ? t_far : far;
    }
    return near <= far;
  }

 private:
  struct Axis {
    std::int64_t origin, floor, ceil;
    bool backward;  ///< the floor bound is negative
  };

  IntSlabsRaySetup set_up_;
  std::array<Axis, 3> axes_{};
  int trimmed_;
  std::int64_t length_ = 0;
};

using IntSlabsTestMaker = IntTestMaker<IntSlabsTest>;

}  // namespace hitpipe::ref
