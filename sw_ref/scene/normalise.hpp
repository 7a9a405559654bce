// The uniform transform from a scene's own units into the cube that all later stages work in.
#pragma once

#include <span>

#include <glm/vec3.hpp>

#include "sw_ref/scene/mesh.hpp"

namespace hitpipe::ref {

/// Largest |coordinate| of the mesh, the eye and the lights. What is left to 1 takes the padding of the boxes
/// (5e-7) and the rounding of computed points.
constexpr double cube_bound = 1.0 - 0x1p-10;

/// The mesh's longest side must be at least this part of the cube's, else too few grid units of an integer
/// unit are left for it: at 16 bits 2^-10 of the cube is 32 of 2^15 units.
constexpr double smallest_mesh_part = 0x1p-10;

/// cube = (own - offset) * scale. Power-of-two changes of the own units change no bit of the result.
struct Normalisation {
  glm::dvec3 offset{0.0};  ///< the centre, in own units
  double scale = 1.0;      ///< > 0

  [[nodiscard]] glm::dvec3 to_cube(const glm::dvec3& own) const { return (own - offset) * scale; }
  [[nodiscard]] glm::dvec3 to_own(const glm::dvec3& cube) const { return cube / scale + offset; }
};

/// A box in own units.
struct Bounds {
  glm::dvec3 min;
  glm::dvec3 max;

  [[nodiscard]] glm::dvec3 centre() const { return min * 0.5 + max * 0.5; }
  /// Length of the longest side.
  [[nodiscard]] double longest() const;
  void grow(const glm::dvec3& point);
};

/// Of the vertices that triangles use; the mesh has at least one triangle.
[[nodiscard]] Bounds mesh_bounds(const Mesh& mesh);

/// Fits the box and the points, which are finite, into +-cube_bound; at least one side of the union has
/// length.
[[nodiscard]] Normalisation fit_to_cube(Bounds box, std::span<const glm::dvec3> points);

/// Moves the vertices, each computed in double and rounded to binary32 once, and drops and counts the
/// triangles that lose their area by it. Vertices that no triangle uses are left where they are, cut to the
/// cube. Throws std::runtime_error when no triangle is left.
void normalise(Mesh& mesh, const Normalisation& normalisation);

/// A point moved and rounded in the same way. Throws std::logic_error when it is not within +-cube_bound.
[[nodiscard]] glm::vec3 normalised(const glm::dvec3& own, const Normalisation& normalisation);

}  // namespace hitpipe::ref
