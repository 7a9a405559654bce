// Camera, lights and materials for a mesh file.
#pragma once

#include <span>
#include <string>

#include "rays/files/mesh_file.hpp"
#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

/// Camera in front, a little above and to the right; a warm light at its upper left, a weaker one at its
/// right. A room is seen and lit from inside. Triangles of `groups` have the surfaces that these state, all
/// others one plain material. A scene has at most 256 materials; a group beyond them gets the most similar
/// one.
[[nodiscard]] SceneDescription mesh_scene(SourceMesh mesh, std::string name,
                                          std::span<const MeshGroup> groups = {});

}  // namespace hitpipe::ref
