// The uniform transform from a scene's own units into the cube that all later stages work in.
#pragma once

#include <cstdint>
#include <span>

#include <glm/vec3.hpp>

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// Largest |coordinate| of the mesh, the eye and the lights. The rest up to 1 is for the padding of the boxes
/// (5e-7) and the rounding of computed points.
constexpr double cube_bound = 1.0 - 0x1p-10;

/// The mesh's longest side must be at least this part of the cube's. Otherwise the grid of an integer unit
/// has too few steps for it: at 16 bits 2^-10 of the cube is 32 of 2^15 steps.
constexpr double smallest_mesh_part = 0x1p-10;

/// cube = (own - offset) * scale. Multiplying the scene's own units by a power of two changes no bit of the
/// result.
struct Normalisation {
  glm::dvec3 offset{0.0};  ///< the centre, in own units
  double scale = 1.0;      ///< > 0
  bool chosen = false;     ///< by a CubeChoice: a ray that begins outside is refused

  [[nodiscard]] glm::dvec3 to_cube(const glm::dvec3& own) const { return (own - offset) * scale; }
  [[nodiscard]] glm::dvec3 to_own(const glm::dvec3& cube) const { return cube / scale + offset; }
};

/// A cube that somebody wants, in own units: its middle, and half its side, more than 0.
struct CubeChoice {
  glm::dvec3 centre{0.0};
  double half = 1.0;
};

/// Triangles that lose their area when their corners are rounded. The thickness of a triangle is its height over
/// its longest side, in own units.
struct Losses {
  std::uint32_t triangles = 0;
  double thinnest = 0.0;
  double thickest = 0.0;

  void add(double thickness);
};

/// The height over the longest side.
[[nodiscard]] double thickness(const SourceMesh::Corners& corners);

/// A box in own units.
struct Bounds {
  glm::dvec3 min;
  glm::dvec3 max;

  [[nodiscard]] glm::dvec3 centre() const { return min * 0.5 + max * 0.5; }
  /// Length of the longest side.
  [[nodiscard]] double longest() const;
  void grow(const glm::dvec3& point);
};

/// The bounds of the vertices that triangles use; the mesh must have a triangle.
[[nodiscard]] Bounds mesh_bounds(const SourceMesh& mesh);
[[nodiscard]] Bounds mesh_bounds(const Mesh& mesh);

/// Fits the box and the points into +-cube_bound. They must be finite, and their union must have some extent.
[[nodiscard]] Normalisation fit_to_cube(Bounds box, std::span<const glm::dvec3> points);

/// The mesh in the cube. Each vertex is computed in double and rounded to binary32 once. Triangles that lose
/// their area are dropped, and counted in `lost`. Vertices that no triangle uses are not moved, only cut to the
/// cube. Throws std::runtime_error if no triangle is left.
[[nodiscard]] Mesh normalise(SourceMesh mesh, const Normalisation& normalisation, Losses& lost);

/// A point, moved and rounded in the same way. Throws std::logic_error if it is not within +-cube_bound.
[[nodiscard]] glm::vec3 normalised(const glm::dvec3& own, const Normalisation& normalisation);

}  // namespace hitpipe::ref
