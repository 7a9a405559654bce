// A mesh of the integer world: corners on a grid of n bits, and the same mesh in binary32 for what reads
// meshes.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rays/mesh/mesh.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/tree/closed.hpp"

namespace hitpipe::ref {

/// Corners on the grid of n bits, by axis; -G..G.
struct IntTriangle {
  using Corner = std::array<std::int32_t, 3>;

  std::array<Corner, 3> corners{};

  friend bool operator==(const IntTriangle&, const IntTriangle&) = default;
};

/// No area: the corners are equal or in a line. No ray hits such a triangle.
[[nodiscard]] bool is_degenerate(const IntTriangle& triangle);

struct IntMesh {
  int coord_bits = 0;                  ///< n
  std::vector<IntTriangle> triangles;  ///< none is degenerate
  Losses lost;                         ///< on this grid; thicknesses are in the cube
  double largest_movement = 0;         ///< of a corner, in units of the [-1, 1] cube
  /// The same triangles in binary32: corner / G. Rounding them again gives the same integers. Triangles have the
  /// numbers that they had.
  Mesh mesh;
};

/// Corners are rounded to round(G x), ties up. The mesh must lie in the cube and have at most 2^31 - 1
/// triangles; n is in 4..24. Throws std::invalid_argument for another n and std::out_of_range for a corner
/// outside the cube.
[[nodiscard]] IntMesh int_mesh(const Mesh& mesh, int coord_bits);

/// How many triangles of the mesh would lose their area on a grid of so many bits.
[[nodiscard]] std::uint32_t lost_on_grid(const Mesh& mesh, int coord_bits);

/// Of the triangles that are there, in units of the grid. So even() is true if and only if no line of this world
/// crosses them an odd number of times. Triangles have their numbers in the integer mesh.
[[nodiscard]] Closedness closedness(const IntMesh& mesh);
/// The same of triangles that have all their numbers.
[[nodiscard]] Closedness closedness(std::span<const IntTriangle> triangles);

}  // namespace hitpipe::ref
