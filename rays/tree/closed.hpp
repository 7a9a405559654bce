// Is a mesh closed, and where not? Edges are pairs of positions, so it does not matter whether triangles share
// indices (an STL file has none). Triangles without area have edges too: they take part.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// An edge with an odd number of triangles, and one of these, by its number in the source.
struct OddEdge {
  glm::vec3 from{0.0F}, to{0.0F};
  std::uint32_t triangle = 0;
};

/// A corner that lies exactly on an odd edge, between its ends; and a triangle of that edge, by its number in
/// the source.
struct TJunction {
  glm::vec3 corner{0.0F};
  std::uint32_t triangle = 0;
};

/// A triangle with two equal corners has one edge twice, and is left out: it changes nothing.
struct Closedness {
  static constexpr std::size_t most_places = 3;  ///< of each kind

  std::uint64_t edges = 0;         ///< pairs of different positions
  std::uint64_t odd = 0;           ///< edges with an odd number of triangles
  std::uint64_t turned = 0;        ///< edges that are not passed as often in one direction as in the other
  std::uint64_t crowded = 0;       ///< edges with more than two triangles
  std::uint64_t t_junctions = 0;   ///< corners of turned edges that lie on an odd edge, between its ends
  std::uint64_t open = 0;          ///< parts of edges between corners that have an odd number of triangles
  std::uint64_t open_turned = 0;   ///< parts that are not passed as often in either direction
  std::vector<OddEdge> first_odd;  ///< those of the lowest triangles
  std::vector<TJunction> first_junctions;  ///< of the lowest triangles

  /// By ends. It stays so wherever corners are moved, if equal corners stay equal and no triangle is left out.
  [[nodiscard]] bool closed() const { return odd == 0; }
  /// Each edge has as many triangles on one side as on the other. It implies closed(), and stays as that does.
  [[nodiscard]] bool oriented() const { return turned == 0; }
  /// In these very places a line crosses the mesh an even number of times: true if and only if no line crosses
  /// it an odd number of times. It may depend on a corner that lies exactly on an edge.
  [[nodiscard]] bool even() const { return open == 0; }
  /// Likewise for the sum of the sides, which is 0.
  [[nodiscard]] bool balanced() const { return open_turned == 0; }
};

/// Of a mesh of finite corners, with the triangles that it has dropped, as far as their corners are known.
[[nodiscard]] Closedness closedness(const Mesh& mesh);

}  // namespace hitpipe::ref
