#include "sw_ref/scene/scene_file.hpp"

#include <algorithm>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "host/outputs.hpp"
#include "host/reject.hpp"
#include "host/text.hpp"
#include "rays/files/json_place.hpp"
#include "rays/files/mesh_file.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/mesh_scene.hpp"

namespace hitpipe::ref {
namespace {

Material read_material(const Place& place) {
  place.expect_object({"albedo", "reflect", "transmit", "refractive_index"});
  Material material;
  // If a material names any part, the other parts are absent.
  if (place.has("reflect") || place.has("transmit")) material.albedo = glm::vec3(0.0F);
  if (place.has("albedo")) material.albedo = place.at("albedo").colour(1.0);
  if (place.has("reflect")) material.reflect = place.at("reflect").colour(1.0);
  if (place.has("transmit")) material.transmit = place.at("transmit").colour(1.0);
  if (place.has("refractive_index")) {
    const Place index = place.at("refractive_index");
    material.refractive_index = static_cast<float>(index.number());
    if (!(material.refractive_index >= 0.1F && material.refractive_index <= 10.0F))
      index.fail(fmt::format("{} is out of range; allowed is 0.1 to 10", index.number()));
  }
  const glm::vec3 sum = material.albedo + material.reflect + material.transmit;
  if (!(std::max({sum.x, sum.y, sum.z}) <= 1.0F + 0x1p-20F))
    place.fail(fmt::format("albedo, reflect and transmit add up to ({}, {}, {}); at most 1 is allowed", sum.x,
                           sum.y, sum.z));
  return material;
}

void read_camera(const Place& place, SceneDescription& scene) {
  place.expect_object({"eye", "target", "up", "fov", "projection"});
  if (place.has("eye")) scene.eye = place.at("eye").vector();
  if (place.has("target")) scene.target = place.at("target").vector();
  if (place.has("up")) scene.up = place.at("up").vector();
  if (place.has("fov")) scene.fov_degrees = place.at("fov").number();
  if (!(scene.fov_degrees > 0.0 && scene.fov_degrees < 180.0))
    place.at("fov").fail(
        fmt::format("{} is out of range; allowed is more than 0 and less than 180", scene.fov_degrees));
  if (!place.has("projection")) return;
  const std::string projection = place.at("projection").word();
  if (projection != "perspective" && projection != "orthographic")
    place.at("projection")
        .fail(fmt::format("\"{}\" is no projection; allowed are perspective and orthographic",
                          host::shortened(projection)));
  scene.projection = projection == "orthographic" ? Projection::orthographic : Projection::perspective;
}

LightSource read_light(const Place& place) {
  place.expect_object({"position", "direction", "intensity"});
  if (place.has("position") == place.has("direction"))
    place.fail("needs exactly one of the keys: position, direction");
  LightSource light;
  light.kind = place.has("direction") ? LightKind::sun : LightKind::point;
  light.position = place.at(place.has("direction") ? "direction" : "position").vector();
  if (light.kind == LightKind::sun && light.position == glm::dvec3(0.0))
    place.at("direction").fail("is zero; one number must differ from 0");
  if (place.has("intensity"))
    light.intensity = place.at("intensity").colour(std::numeric_limits<double>::infinity());
  return light;
}

/// Materials by name, and the triangles that have them.
class Surfaces {
 public:
  Surfaces(SceneDescription& scene, const std::vector<MeshGroup>& groups)
      : scene_(&scene), groups_(&groups) {}

  void read_materials(const Place& place) {
    constexpr std::size_t most = 256;  // the index of a triangle's material is one byte
    for (const auto& [name, value] : place.members()) {
      if (scene_->materials.size() == most)
        place.fail(fmt::format("at most {} materials are allowed, with the scene's own", most));
      numbers_[name] = static_cast<std::uint8_t>(scene_->materials.size());
      scene_->materials.push_back(read_material(value));
    }
  }
  void read_default(const Place& place) {
    scene_->mesh.materials.assign(scene_->mesh.triangles.size(), number(place));
  }
  void read_assignment(const Place& place) {
    place.expect_object({"material", "group", "group_material", "triangles"});
    const std::uint8_t material = number(place.at("material"));
    if (place.has("group") + place.has("group_material") + place.has("triangles") != 1)
      place.fail("needs exactly one of the keys: group, group_material, triangles");
    if (place.has("triangles")) {
      assign_range(place.at("triangles"), material);
    } else if (place.has("group")) {
      assign_groups(place.at("group"), &MeshGroup::name, material);
    } else {
      assign_groups(place.at("group_material"), &MeshGroup::material, material);
    }
  }

 private:
  [[nodiscard]] std::uint8_t number(const Place& place) const {
    const auto found = numbers_.find(place.word());
    if (found == numbers_.end()) {
      std::vector<std::string> names;
      for (const auto& [name, number] : numbers_) names.push_back(host::shortened(name));
      place.fail(fmt::format("there is no material \"{}\"; there are: {}", host::shortened(place.word()),
                             names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))));
    }
    return found->second;
  }
  void assign(std::size_t first, std::size_t end, std::uint8_t material) {
    std::vector<std::uint8_t>& all = scene_->mesh.materials;
    all.resize(scene_->mesh.triangles.size(), 0);
    std::fill(all.begin() + static_cast<std::ptrdiff_t>(first),
              all.begin() + static_cast<std::ptrdiff_t>(end), material);
  }
  void assign_range(const Place& place, std::uint8_t material) {
    const std::vector<Place> ends = place.elements();
    if (ends.size() != 2) place.fail("must be an array of two numbers, the first and the last triangle");
    const TriangleNumbers numbers(scene_->mesh);
    const std::uint64_t last_of_all = numbers.in_source() - 1;
    const std::uint64_t first = ends[0].count(last_of_all);
    const std::uint64_t last = ends[1].count(last_of_all);
    if (first > last)
      place.fail(fmt::format("the first triangle, {}, comes after the last, {}", first, last));
    assign(numbers.kept_below(static_cast<std::uint32_t>(first)),
           numbers.kept_below(static_cast<std::uint32_t>(last + 1)), material);
  }
  void assign_groups(const Place& place, std::string MeshGroup::*label, std::uint8_t material) {
    const std::string wanted = place.word();
    std::set<std::string> known;
    bool found = false;
    for (const MeshGroup& group : *groups_) {
      if (!(group.*label).empty()) known.insert(host::shortened(group.*label));
      if (group.*label != wanted) continue;
      found = true;
      assign(group.first, group.first + group.count, material);
    }
    if (!found)
      place.fail(fmt::format("the mesh has no \"{}\"; it has: {}", host::shortened(wanted),
                             known.empty() ? "no names" : fmt::format("{}", fmt::join(known, ", "))));
  }

  SceneDescription* scene_;
  const std::vector<MeshGroup>* groups_;
  std::map<std::string, std::uint8_t> numbers_;
};

/// The mesh or built-in scene, with its own camera, lights and materials.
SceneDescription read_base(const Place& top, const std::filesystem::path& file,
                           std::optional<std::size_t> triangles, std::vector<MeshGroup>& groups) {
  if (top.has("mesh") == top.has("built_in")) top.fail("needs exactly one of the keys: mesh, built_in");
  if (top.has("mesh")) {
    if (top.has("triangles") || triangles)
      top.fail(fmt::format("a mesh file has the triangles it has; their number can be chosen for: {}",
                           scaling_names()));
    const std::filesystem::path mesh = file.parent_path() / top.at("mesh").word();
    host::never_replace(mesh);
    SourceMesh triangles_of_file = load_mesh(mesh, groups);
    return mesh_scene(std::move(triangles_of_file), file.stem().string(), groups);
  }
  const Place name = top.at("built_in");
  if (!find_built_in(name.word()))
    name.fail(fmt::format("there is no scene \"{}\"; there are: {}", host::shortened(name.word()),
                          built_in_names()));
  if (top.has("triangles") && !triangles)
    triangles = top.at("triangles").count(std::numeric_limits<std::uint32_t>::max());
  return make_built_in(name.word(), triangles);
}

SceneDescription read(const std::filesystem::path& file, std::optional<std::size_t> triangles) {
  const nlohmann::json text = parse_json(file);
  const Place top(text);
  top.expect_object(
      {"mesh", "built_in", "triangles", "camera", "lights", "materials", "default_material", "assign"});
  std::vector<MeshGroup> groups;
  SceneDescription scene = read_base(top, file, triangles, groups);
  scene.name = file.stem().string();
  if (top.has("camera")) read_camera(top.at("camera"), scene);
  if (top.has("lights")) {
    scene.lights.clear();
    for (const Place& light : top.at("lights").elements()) scene.lights.push_back(read_light(light));
  }
  Surfaces surfaces(scene, groups);
  if (top.has("materials")) surfaces.read_materials(top.at("materials"));
  if (top.has("default_material")) surfaces.read_default(top.at("default_material"));
  if (top.has("assign")) {
    for (const Place& assignment : top.at("assign").elements()) surfaces.read_assignment(assignment);
  }
  return scene;
}

}  // namespace

bool is_scene_file(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
  return extension == ".json";
}

SceneDescription read_scene_file(const std::filesystem::path& file, std::optional<std::size_t> triangles) {
  try {
    return read(file, triangles);
  } catch (const std::exception& error) {
    throw std::runtime_error(fmt::format("scene file \"{}\": {}", file.string(), one_line(error.what())));
  }
}

}  // namespace hitpipe::ref
