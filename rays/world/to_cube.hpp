// Rays and boxes in a scene's own units, moved into the cube and rounded to binary32 so that a ray that meets
// a box there meets the rounded box too.
#pragma once

#include <glm/vec3.hpp>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/scene/normalise.hpp"

namespace hitpipe::ref {

/// The least binary32 that is not below the moved coordinate (own - offset) * scale; in doubt the next one.
[[nodiscard]] float plane_above(double own, double offset, double scale);
/// The greatest that is not above it, in the same way.
[[nodiscard]] float plane_below(double own, double offset, double scale);

/// The least box that holds the moved one, or in doubt a binary32 larger. A coordinate that binary32 cannot
/// hold becomes infinite.
[[nodiscard]] Aabb box_to_cube(const BasicAabb<double>& box, const Normalisation& transform);

/// All numbers are rounded to nearest. The direction stays as it is, so the length is scaled.
[[nodiscard]] Ray ray_to_cube(const glm::dvec3& origin, const glm::dvec3& direction, double length,
                              const Normalisation& transform);

/// Where a ray may begin. With a NaN in it no point is inside.
struct Origins {
  glm::vec3 least, most;

  [[nodiscard]] bool hold(const glm::vec3& origin) const {
    return origin.x >= least.x && origin.x <= most.x && origin.y >= least.y && origin.y <= most.y &&
           origin.z >= least.z && origin.z <= most.z;
  }
};

/// The points with coordinates of at most `limit` that ray_to_cube() puts into [-1, 1], so that whoever asks need not
/// move the ray. If there is none on an axis, least > most there.
[[nodiscard]] Origins origins_in_cube(const Normalisation& transform, float limit);

}  // namespace hitpipe::ref
