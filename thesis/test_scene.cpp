#include "thesis/test_scene.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "thesis/printed.hpp"

namespace hitpipe::thesis {

std::vector<std::string> scenes_of_table(std::string_view number, const ExperimentOptions& options) {
  const PrintedTable& printed = printed_table(number);
  std::vector<std::string> all;
  for (const PrintedRow& row : printed.rows()) {
    const std::string& name = row.text(printed.columns().front());
    if (std::find(all.begin(), all.end(), name) == all.end()) all.push_back(name);
  }
  if (options.only.empty()) return all;
  for (const std::string& name : options.only)
    if (std::find(all.begin(), all.end(), name) == all.end())
      throw std::runtime_error(
          fmt::format("table {} has no scene \"{}\"; it has: {}", number, name, fmt::join(all, ", ")));
  std::erase_if(all, [&](const std::string& name) {
    return std::find(options.only.begin(), options.only.end(), name) == options.only.end();
  });
  return all;
}

std::optional<Scene> test_scene(const std::string& name, const ExperimentOptions& options) {
  if (const auto given = options.scenes.find(name); given != options.scenes.end())
    return load_scene(given->second);
  const std::span<const BuiltInScene> all = built_in_scenes();
  const auto stand_in = std::find_if(all.begin(), all.end(),
                                     [&](const BuiltInScene& scene) { return scene.stands_for == name; });
  if (stand_in == all.end()) return std::nullopt;
  SceneOptions placing;
  if (stand_in->scales()) placing.triangles = options.triangles;
  return load_scene(stand_in->name, placing);
}

std::string scene_note(const std::string& name, const std::optional<Scene>& scene) {
  if (!scene) return fmt::format("{}: not measured; give a mesh with --scene {}=FILE", name, name);
  const Mesh& mesh = scene->mesh;
  const std::string gone = mesh.dropped.empty() ? ""
                                                : fmt::format(" ({} without area, {} lost to rounding)",
                                                              mesh.without_area, mesh.lost());
  return fmt::format("{}: {}, {} triangles{}", name, scene->name, mesh.triangles.size(), gone);
}

}  // namespace hitpipe::thesis
