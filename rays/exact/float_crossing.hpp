// Exactly once in the float world: the rule of rays/world/crossing.hpp for rays and corners of binary32, decided by
// exact arithmetic. A line crosses a closed mesh an even number of times, always. The move of eps and eps^2 goes along
// y and z, and along x in place of the one that is the major axis, as in the integer world.
#pragma once

#include <optional>

#include "rays/exact/exact_triangle.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// A hit of the closed triangle, as intersect_triangle() has it, and whether it counts.
struct FloatCrossing {
  triangle_filter::Enclosure t{};  ///< of the exact t, in units of the ray's direction
  int side = 0;                    ///< the sign of direction . (b - a) x (c - a), which is never 0
  bool tie = false;                ///< at an edge or a corner; it counts or not
  bool once = false;               ///< it counts; true for all that are no tie
};

/// Nothing when the ray does not hit the triangle. Corners and ray are finite binary32 values.
[[nodiscard]] std::optional<FloatCrossing> float_crossing(const Mesh::Corners& corners, const Ray& ray);

}  // namespace hitpipe::ref
