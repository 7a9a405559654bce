// Scene files (.json): a mesh or built-in scene with camera, lights and materials; docs/scenes.md describes
// them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

/// Whether the path is a scene file, by its extension.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& file);

/// `triangles` replaces the file's number for a built-in scene. Settings that the file omits come from the
/// scene or mesh. Throws std::runtime_error, one line that names the file, the place in it and what is
/// allowed, for a file that is missing or not JSON, an unknown, doubled or missing key, a value of the wrong
/// kind or out of range, and an unknown name; also as load_mesh() and make_built_in() do.
[[nodiscard]] SceneDescription read_scene_file(const std::filesystem::path& file,
                                               std::optional<std::size_t> triangles = {});

}  // namespace hitpipe::ref
