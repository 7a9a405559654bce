// Meshes and where they are, in units of their own.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// A corner of the mesh is at linear * corner + move in the world.
struct OwnInstance {
  std::uint32_t mesh = 0;
  glm::dmat3 linear{1.0};
  glm::dvec3 move{0.0};
  std::uint8_t mask = 0xff;  ///< a ray meets it if they have a bit in common
};

struct OwnInstances {
  std::vector<SourceMesh> meshes;
  std::vector<OwnInstance> instances;
};

}  // namespace hitpipe::ref
