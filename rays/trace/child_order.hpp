// Which child of a branch a ray visits first, by direction and split axis (DSA, section 4.5, Table 4.2).
#pragma once

#include <cmath>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

constexpr unsigned direction_classes = 8;

/// Bits 0..2: the signs of the direction's x, y, z (1: negative, -0 included), the thesis's M and P.
[[nodiscard]] inline unsigned direction_class(const glm::vec3& direction) {
  return static_cast<unsigned>(std::signbit(direction.x)) |
         static_cast<unsigned>(std::signbit(direction.y)) << 1U |
         static_cast<unsigned>(std::signbit(direction.z)) << 2U;
}

/// Table 4.2: 0 or 1, the child of a branch split along `axis` (0..2) that a ray of this class visits first.
/// Class 0 always visits child 0 first: the fixed order of BVH-Slabs and BVH-Plu.
[[nodiscard]] inline unsigned near_child(unsigned direction_class, int axis) {
  return direction_class >> static_cast<unsigned>(axis) & 1U;
}

}  // namespace hitpipe::ref
