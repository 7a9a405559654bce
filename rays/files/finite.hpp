// Positions whose coordinates are numbers.
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

[[nodiscard]] inline bool has_finite_coordinates(const glm::dvec3& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

}  // namespace hitpipe::ref
