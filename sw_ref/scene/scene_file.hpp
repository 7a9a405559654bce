// Scene files (.json): a mesh or built-in scene with camera, lights and materials; docs/scenes.md describes
// them.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// By its extension.
[[nodiscard]] bool is_scene_file(const std::filesystem::path& file);

/// `triangles` replaces the number that the file asks of a built-in scene. What the file leaves out is as the
/// scene or mesh has it alone. Throws std::runtime_error, one line that names the file, the place in it and
/// what is allowed: for a file that is missing or no JSON, an unknown, doubled or missing key, a value of the
/// wrong kind or out of range, a name that nothing has; and as load_mesh() and make_built_in() do.
[[nodiscard]] SceneDescription read_scene_file(const std::filesystem::path& file,
                                               std::optional<std::size_t> triangles = {});

}  // namespace hitpipe::ref
