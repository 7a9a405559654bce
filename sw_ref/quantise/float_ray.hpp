// Ray set-up for the float units in binary32 (sections 2.3.1 and 3.3): inverse direction for slabs, endpoint
// for Pluecker. Computed as a program would, in rounded numbers, so it proves nothing.
#pragma once

#include <glm/vec3.hpp>

#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// 1 / d, each component rounded to nearest: the IRDVCs. 1 / +-0 is an infinity of that sign.
[[nodiscard]] glm::vec3 float_irdvc(const glm::vec3& direction);

/// Where a ray ends.
struct FloatEndpoint {
  glm::vec3 at{0};        ///< the origin with `infinite`
  bool infinite = false;  ///< the ray has no end that binary32 can hold: the unit then ignores `at`

  friend bool operator==(const FloatEndpoint&, const FloatEndpoint&) = default;
};

/// origin + length * direction. Each component is rounded once from the exact sum, outward along the ray: up
/// if the direction is positive, down if it is negative. For acceptable rays (box_referee.hpp). Throws
/// std::invalid_argument unless length >= 0 or infinite.
[[nodiscard]] FloatEndpoint float_endpoint(const Ray& ray, float length);

}  // namespace hitpipe::ref
