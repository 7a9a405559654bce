// Scenes by the names that users give them: built-in ones, scene files and files of meshes.
#pragma once

#include <string>

#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

/// Reads the input of place(): a built-in scene by name, or a scene file (.json) or mesh file by path. A mesh
/// file gets a camera and two lights chosen from its bounds. Throws std::runtime_error, one line, for an
/// unknown name, for a number of triangles that the scene cannot have, and as load_mesh() and
/// read_scene_file() do.
[[nodiscard]] SceneDescription describe_scene(const std::string& name_or_path,
                                              const SceneOptions& options = {});

/// The same, placed. Throws also as place() does.
[[nodiscard]] Scene load_scene(const std::string& name_or_path, const SceneOptions& options = {});

}  // namespace hitpipe::ref
