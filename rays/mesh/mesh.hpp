// Indexed triangles: of a scene in its own units, or in the cube, where corners are binary32.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// Each triangle has a number: its place among all triangles of the file, or of the built-in scene, from 0. The
/// mesh lacks some of them, but keeps their order.
template <class Vertex>
struct MeshOf {
  std::vector<Vertex> vertices;
  std::vector<glm::vec3> normals;       ///< one unit vector per vertex for smooth shading; empty: flat
  std::vector<glm::uvec3> triangles;    ///< indices into `vertices`
  std::vector<std::uint8_t> materials;  ///< one per triangle, index into Scene::materials; empty: all 0
  std::vector<std::uint32_t> dropped;   ///< numbers of the triangles that the mesh lacks, ascending
  /// By dropped triangle: its corners, indices into `vertices`. Empty if they are not known.
  std::vector<glm::uvec3> dropped_corners;
  std::uint32_t without_area = 0;  ///< how many of those have no area in the source
  /// By face of the file: the number of its first triangle, ascending. Empty: face i is triangle i.
  std::vector<std::uint32_t> faces;

  /// How many have an area in the source, and lost it when their corners were rounded.
  [[nodiscard]] std::size_t lost() const { return dropped.size() - without_area; }

  struct Corners {
    Vertex a, b, c;
  };
  [[nodiscard]] Corners corners(std::uint32_t triangle) const {
    const glm::uvec3& t = triangles[triangle];
    return {vertices[t.x], vertices[t.y], vertices[t.z]};
  }
};

using Mesh = MeshOf<glm::vec3>;
/// In the units of its file or scene, not rounded.
using SourceMesh = MeshOf<glm::dvec3>;

/// The mesh with other vertices in the same order.
template <class To, class From>
[[nodiscard]] MeshOf<To> with_vertices(MeshOf<From> mesh, std::vector<To> vertices) {
  return {.vertices = std::move(vertices),
          .normals = std::move(mesh.normals),
          .triangles = std::move(mesh.triangles),
          .materials = std::move(mesh.materials),
          .dropped = std::move(mesh.dropped),
          .dropped_corners = std::move(mesh.dropped_corners),
          .without_area = mesh.without_area,
          .faces = std::move(mesh.faces)};
}

}  // namespace hitpipe::ref
