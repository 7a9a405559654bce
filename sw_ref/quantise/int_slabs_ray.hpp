// Ray set-up for the integer slabs unit (section 6.2.1): rounded origin, inverse ray direction vector
// components (IRDVCs) bounded from both sides, and the ray length on the scale of the distances. Every result
// is exact: the code computes with integers made of the binary32's mantissas and exponents, without a
// floating-point operation. G and M are as in grid.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "hls/box/int_format.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

struct IntSlabsRay {
  std::array<std::int32_t, 3> origin{};       ///< n bits, |.| <= G
  std::array<std::int32_t, 3> irdvc_floor{};  ///< n bits, |.| <= M
  std::array<std::int32_t, 3> irdvc_ceil{};   ///< n bits, |.| <= M; floor or floor + 1
  std::int64_t length = 0;                    ///< trimmed to t - 1 bits, >= 0
  bool infinite = false;  ///< the unit then ignores `length`, which is the largest possible

  friend bool operator==(const IntSlabsRay&, const IntSlabsRay&) = default;
};

/// The exact set-up of one ray for an n/t unit.
class IntSlabsRaySetup {
 public:
  /// Needs an acceptable ray (see box_referee.hpp) and 6 <= n <= 32, 6 <= t <= 2n-1. Throws std::out_of_range
  /// for an origin outside [-1, 1]^3, and std::invalid_argument otherwise.
  IntSlabsRaySetup(const Ray& ray, hls::IntBits bits);

  [[nodiscard]] const IntSlabsRay& ray() const { return ray_; }

  /// The trimmed length if the same ray ended at `length`. Throws std::invalid_argument unless length >= 0 or
  /// infinite.
  [[nodiscard]] std::int64_t length(float length) const;

 private:
  __extension__ using Uint128 = unsigned __int128;

  void set_irdvcs(const Ray& ray);

  IntSlabsRay ray_;
  hls::IntBits bits_;
  // scale * G = length_factor_ * 2^length_exponent_; 0 if the scale is infinitesimal.
  Uint128 length_factor_ = 0;  // < 2^85
  int length_exponent_ = 0;    // -149..104
};

}  // namespace hitpipe::ref
