// Ray set-up for the integer Pluecker unit (section 6.3.1): rounded origin, rounded direction, and the
// endpoint rounded outward along the ray. Every result is the exact value rounded once: the code computes
// with integers made of the binary32's mantissas and exponents. G and M are as in grid.hpp.
#pragma once

#include <array>
#include <cstdint>

#include "hls/box/int_format.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// Where a ray ends on the grid.
struct IntEndpoint {
  std::array<std::int32_t, 3> at{};  ///< n bits, |.| <= G; the rounded origin with `infinite`
  bool infinite = false;             ///< the ray leaves the cube or has no end: the unit then ignores `at`

  friend bool operator==(const IntEndpoint&, const IntEndpoint&) = default;
};

struct IntPluckerRay {
  std::array<std::int32_t, 3> origin{};     ///< n bits, |.| <= G
  std::array<std::int32_t, 3> direction{};  ///< n bits, |.| <= M; the largest component is +-M
  IntEndpoint end;

  friend bool operator==(const IntPluckerRay&, const IntPluckerRay&) = default;
};

/// The exact set-up of one ray for an n/t unit; t has no effect.
class IntPluckerRaySetup {
 public:
  /// Needs an acceptable ray (see box_referee.hpp) and a valid format. Throws std::out_of_range for an origin
  /// outside [-1, 1]^3, and std::invalid_argument otherwise.
  IntPluckerRaySetup(const Ray& ray, hls::IntBits bits);

  [[nodiscard]] const IntPluckerRay& ray() const { return ray_; }

  /// The endpoint if the same ray ended at `length`. Throws std::invalid_argument unless length >= 0 or
  /// infinite.
  [[nodiscard]] IntEndpoint endpoint(float length) const;

 private:
  void set_direction();

  Ray exact_;
  int coord_bits_;
  IntPluckerRay ray_;
};

}  // namespace hitpipe::ref
