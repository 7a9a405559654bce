#include "thesis/proposals.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::thesis {

std::vector<std::string> proposal_scenes(std::string_view number, const ExperimentOptions& options) {
  for (const std::string& name : options.only)
    if (find_built_in(name) == nullptr)
      throw std::runtime_error(
          fmt::format("table {} has no scene \"{}\"; it has: {}", number, name, built_in_names()));
  if (!options.only.empty()) return options.only;
  std::vector<std::string> all;
  for (const BuiltInScene& scene : built_in_scenes()) all.emplace_back(scene.name);
  return all;
}

Scene proposal_scene(const std::string& name, const ExperimentOptions& options) {
  const BuiltInScene& scene = *find_built_in(name);
  SceneOptions placing;
  if (scene.scales() && options.triangles)
    placing.triangles = std::clamp(static_cast<std::size_t>(*options.triangles), scene.least, scene.most);
  return load_scene(name, placing);
}

}  // namespace hitpipe::thesis
