// The surface area heuristic (MacDonald and Booth 1990): the work for a random line that meets the root. The
// probability that a line through a convex box meets a box inside it is the ratio of their surface areas.
#pragma once

#include <glm/vec3.hpp>

#include "sw_ref/scene/aabb.hpp"

namespace hitpipe::ref {

/// The costs of visiting a branch, which is two box tests, and of testing one triangle of a leaf. They are
/// equal because the measured times are about equal in hierarchies of 1 to 16 triangles per leaf
/// (docs/bvh.md): 13 to 15 ns a branch, 11 to 13 ns a triangle.
constexpr float traversal_cost = 1.0F;
constexpr float intersection_cost = 1.0F;

/// Half the surface of a box that is not empty.
template <class T>
[[nodiscard]] T half_area(const BasicAabb<T>& box) {
  const glm::vec<3, T> extent = box.max - box.min;
  return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

}  // namespace hitpipe::ref
