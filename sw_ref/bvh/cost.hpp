// The surface area heuristic (MacDonald and Booth 1990): the work for a random line that meets the root. A
// line that meets a convex box meets one inside it with the ratio of their surface areas.
#pragma once

#include <glm/vec3.hpp>

#include "sw_ref/geometry/aabb.hpp"

namespace hitpipe::ref {

/// Of visiting a branch, which is two box tests, and of testing one triangle of a leaf. Equal as measured
/// through hierarchies of 1 to 16 triangles per leaf (docs/bvh.md): 13 to 15 ns a branch, 11 to 13 a
/// triangle.
constexpr float traversal_cost = 1.0F;
constexpr float intersection_cost = 1.0F;

/// Half the surface of a box that is not empty.
template <class T>
[[nodiscard]] T half_area(const BasicAabb<T>& box) {
  const glm::vec<3, T> extent = box.max - box.min;
  return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

}  // namespace hitpipe::ref
