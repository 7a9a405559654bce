#include "sw_ref/scene/mesh.hpp"

#include <utility>

namespace hitpipe::ref {

SourceMesh as_source(Mesh mesh) {
  return {.vertices = {mesh.vertices.begin(), mesh.vertices.end()},
          .normals = std::move(mesh.normals),
          .triangles = std::move(mesh.triangles),
          .materials = std::move(mesh.materials),
          .dropped = std::move(mesh.dropped),
          .without_area = mesh.without_area,
          .faces = std::move(mesh.faces)};
}

}  // namespace hitpipe::ref
