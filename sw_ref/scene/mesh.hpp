// Indexed triangles in binary32.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

struct Mesh {
  std::vector<glm::vec3> vertices;
  std::vector<glm::vec3> normals;       ///< one unit vector per vertex for smooth shading; empty: flat
  std::vector<glm::uvec3> triangles;    ///< indices into `vertices`
  std::vector<std::uint8_t> materials;  ///< one per triangle, index into Scene::materials; empty: all 0
  /// Triangles without area that the reader or the normaliser left out, by their numbers in the source,
  /// ascending. The source numbers all its triangles from 0.
  std::vector<std::uint32_t> dropped;

  struct Corners {
    glm::vec3 a, b, c;
  };
  [[nodiscard]] Corners corners(std::uint32_t triangle) const {
    const glm::uvec3& t = triangles[triangle];
    return {vertices[t.x], vertices[t.y], vertices[t.z]};
  }
};

}  // namespace hitpipe::ref
