#include "sw_ref/scene/load_scene.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/mesh_file.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/mesh_scene.hpp"
#include "sw_ref/scene/scene_file.hpp"

namespace hitpipe::ref {
namespace {

SceneDescription describe(const std::string& name_or_path, std::optional<std::size_t> triangles) {
  if (find_built_in(name_or_path)) return make_built_in(name_or_path, triangles);
  const std::filesystem::path path(name_or_path);
  // A bare word is meant as a name. If the word looks like a path, the file reader's message is better.
  std::error_code ignored;
  if (!path.has_extension() && !path.has_parent_path() && !std::filesystem::exists(path, ignored))
    reject(fmt::format("scene \"{}\": no built-in scene and no file of that name; built-in are: {}",
                       host::shortened(name_or_path), built_in_names()));
  if (is_scene_file(path)) return read_scene_file(path, triangles);
  if (triangles)
    reject(
        fmt::format("scene \"{}\": a mesh file has the triangles it has; their number can be chosen for: {}",
                    name_or_path, scaling_names()));
  std::vector<MeshGroup> groups;
  SourceMesh mesh = load_mesh(path, groups);
  return mesh_scene(std::move(mesh), path.stem().string(), groups);
}

}  // namespace

SceneDescription describe_scene(const std::string& name_or_path, const SceneOptions& options) {
  return with_options(describe(name_or_path, options.triangles), options);
}

Scene load_scene(const std::string& name_or_path, const SceneOptions& options) {
  return place(describe_scene(name_or_path, options));
}

}  // namespace hitpipe::ref
