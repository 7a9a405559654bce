// A caller's mesh, checked.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "hitpipe/scene.h"
#include "rays/mesh/mesh.hpp"
#include "rays/scene/normalise.hpp"

namespace hitpipe::library {

/// The bound of coordinates of corners and origins.
inline constexpr float most_coordinate = 0x1p24F;

struct CheckedMesh {
  ref::Mesh mesh;
  std::vector<bool>
      used;  ///< by corner: whether a triangle uses it; one that none uses may be anything, and is 0 here
};

/// Both throw a Refusal that names the first bad triangle or corner.
[[nodiscard]] CheckedMesh checked_mesh(const hitpipe_mesh& mesh);
/// Triangles that are checked, with other corners.
[[nodiscard]] CheckedMesh with_corners(const float* corners, std::size_t corner_count,
                                       std::vector<glm::uvec3> triangles);

/// Throws a Refusal that names the first bad point.
[[nodiscard]] std::vector<glm::dvec3> checked_points(const float* points, std::size_t count);

/// Takes the mesh and the points into the cube. Throws a Refusal if all are in one place.
[[nodiscard]] ref::Normalisation fitted(const ref::Mesh& mesh, std::span<const glm::dvec3> points = {});

/// Each corner is rounded to binary32, as hitpipe_to_cube_ray() does with an origin. Throws a Refusal that names the
/// first corner outside.
void move_into_cube(CheckedMesh& own, const ref::Normalisation& transform);

}  // namespace hitpipe::library
