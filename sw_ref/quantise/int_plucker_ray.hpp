// Ray set-up for the integer Pluecker unit (section 6.3.1): rounded origin, rounded direction, and the
// endpoint rounded outward along the ray. All exact: integers made of the binary32's mantissas and exponents.
#pragma once

#include <array>
#include <cstdint>

#include "hls/box/int_format.hpp"
#include "sw_ref/geometry/ray.hpp"

namespace hitpipe::ref {

/// Where a ray ends on the grid.
struct IntEndpoint {
  std::array<std::int32_t, 3> at{};  ///< n bits, |.| <= G = 2^(n-2) - 1; the rounded origin with `infinite`
  bool infinite = false;             ///< the ray leaves the cube or has no end: the unit then ignores `at`

  friend bool operator==(const IntEndpoint&, const IntEndpoint&) = default;
};

struct IntPluckerRay {
  std::array<std::int32_t, 3> origin{};     ///< n bits, |.| <= G
  std::array<std::int32_t, 3> direction{};  ///< n bits, |.| <= M = 2^(n-1) - 1, which the largest attains
  IntEndpoint end;

  friend bool operator==(const IntPluckerRay&, const IntPluckerRay&) = default;
};

/// Sets a ray up for an n/t unit; t plays no part.
class IntPluckerRaySetup {
 public:
  /// Needs an acceptable ray (see box_referee.hpp) and a valid format. Throws std::out_of_range for an origin
  /// outside [-1, 1]^3, std::invalid_argument for anything else.
  IntPluckerRaySetup(const Ray& ray, hls::IntBits bits);

  [[nodiscard]] const IntPluckerRay& ray() const { return ray_; }

  /// The endpoint if the same ray ended at `length` >= 0, or infinite. Throws std::invalid_argument
  /// otherwise.
  [[nodiscard]] IntEndpoint endpoint(float length) const;

 private:
  void set_direction();

  Ray exact_;
  int coord_bits_;
  IntPluckerRay ray_;
};

}  // namespace hitpipe::ref
