#include "sw_ref/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "sw_ref/scene/mesh_file.hpp"
#include "sw_ref/scene/room.hpp"

namespace hitpipe::ref {
namespace {

[[noreturn]] void reject(const std::string& reason) {
  throw std::runtime_error(reason);
}

std::string text(const glm::dvec3& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

bool is_finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// Of length 1; scaled first, so that no square leaves the range of a double. v is finite and not zero.
glm::dvec3 unit(const glm::dvec3& v) {
  return glm::normalize(v / largest(v));
}

void check_camera(const SceneDescription& scene) {
  if (!is_finite(scene.eye)) reject(fmt::format("camera: eye {} must be finite", text(scene.eye)));
  if (!is_finite(scene.target)) reject(fmt::format("camera: target {} must be finite", text(scene.target)));
  if (!is_finite(scene.up) || scene.up == glm::dvec3(0.0))
    reject(fmt::format("camera: up {} must be finite and not zero", text(scene.up)));
  if (scene.eye == scene.target)
    reject(fmt::format("camera: eye and target are both {}; they must differ", text(scene.eye)));
  if (!(scene.fov_degrees > 0.0 && scene.fov_degrees < 180.0))
    reject(fmt::format("camera: field of view of {} degrees; allowed is more than 0 and less than 180",
                       scene.fov_degrees));
}

void check_light(const LightSource& light, std::size_t number) {
  if (!is_finite(light.position))
    reject(fmt::format("light {}: position {} must be finite", number, text(light.position)));
  const glm::dvec3& i = light.intensity;
  if (!is_finite(i) || i.x < 0.0 || i.y < 0.0 || i.z < 0.0)
    reject(fmt::format("light {}: intensity {} must be finite and not negative", number, text(i)));
}

/// The mesh vanishes when one point drags the cube's size along; the farthest one is to blame.
void check_distances(const SceneDescription& scene, const Bounds& box, const Normalisation& fit) {
  const double part = box.longest() * fit.scale / 2.0;
  if (part >= smallest_mesh_part) return;
  std::string blamed = fmt::format("camera: eye {}", text(scene.eye));
  double farthest = largest(scene.eye - box.centre());
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const double distance = largest(scene.lights[i].position - box.centre());
    if (distance <= farthest) continue;
    farthest = distance;
    blamed = fmt::format("light {}: position {}", i, text(scene.lights[i].position));
  }
  reject(fmt::format(
      "{} is so far from the mesh that {:.2g} of the scene would be left for it; at least {} is needed",
      blamed, part, smallest_mesh_part));
}

Camera camera(const SceneDescription& scene, const Normalisation& fit) {
  Camera out;
  out.eye = normalised(scene.eye, fit);
  out.forward = unit(scene.target - scene.eye);
  const glm::dvec3 up = unit(scene.up);
  const glm::dvec3 across = glm::cross(out.forward, up);
  constexpr double smallest_sine = 1e-6;  // below, the image's upright would be made of rounding errors
  if (glm::length(across) < smallest_sine)
    reject(fmt::format("camera: up {} is parallel to the view from {} to {}; choose another up",
                       text(scene.up), text(scene.eye), text(scene.target)));
  out.right = unit(across);
  out.up = glm::cross(out.right, out.forward);
  out.tan_half_height = std::tan(glm::radians(scene.fov_degrees / 2.0));
  return out;
}

/// From inside a room towards what stands in it, and lit from below its ceiling.
void move_inside(SceneDescription& scene, const Bounds& walls, const Bounds& contents) {
  constexpr double margin = 0.05;  // of the room, kept between the walls and camera or lights
  const glm::dvec3 low = walls.min + margin * (walls.max - walls.min);
  const glm::dvec3 high = walls.max - margin * (walls.max - walls.min);
  scene.target = contents.centre();
  const double radius = glm::length(contents.max - contents.min) * 0.5;
  const glm::dvec3 back = unit({0.35, 0.25, 1.0});
  constexpr double widest = 75.0;  // degrees; a wider view looks distorted
  const double away = radius / std::sin(glm::radians(50.0 / 2.0));
  scene.eye = glm::clamp(scene.target + back * away, low, high);
  // Where the room leaves less than that distance, the view is as wide as the contents ask.
  const double sine = std::min(1.0, radius / glm::length(scene.eye - scene.target));
  scene.fov_degrees = std::min(widest, glm::degrees(2.0 * std::asin(sine)));
  scene.lights[0].position = glm::mix(low, high, glm::dvec3(0.2, 1.0, 0.8));
  scene.lights[1].position = glm::mix(low, high, glm::dvec3(0.9, 0.8, 0.6));
}

/// Camera in front, a little above and to the right; a warm light at its upper left, a weaker one at its
/// right.
SceneDescription around(Mesh mesh, std::string name) {
  const Bounds box = mesh_bounds(mesh);
  const double radius = glm::length((box.max - box.min) / box.longest()) * 0.5 * box.longest();
  SceneDescription scene{std::move(name), std::move(mesh), {}, {}, box.centre(), {0.0, 1.0, 0.0}, 40.0, {}};
  scene.materials.push_back({{0.72F, 0.66F, 0.58F}});
  scene.eye =
      scene.target + unit({0.45, 0.35, 1.0}) * (radius / std::sin(glm::radians(scene.fov_degrees / 2.0)));
  scene.lights.push_back({scene.target + glm::dvec3(-1.2, 1.8, 1.6) * radius, {0.85, 0.80, 0.72}});
  scene.lights.push_back({scene.target + glm::dvec3(2.0, 0.7, 1.2) * radius, {0.22, 0.25, 0.30}});
  if (const auto contents = room_contents(scene.mesh, box)) move_inside(scene, box, *contents);
  return scene;
}

SceneDescription describe(const std::string& name_or_path) {
  if (name_or_path == "spheres") return spheres();
  const std::filesystem::path path(name_or_path);
  // A bare word was meant as a name; whatever looks like a path gets the mesh reader's message.
  if (!path.has_extension() && !path.has_parent_path() && !std::filesystem::exists(path))
    reject(fmt::format("scene \"{}\": no built-in scene and no file of that name; built-in are: spheres",
                       name_or_path));
  return around(load_mesh(path), path.stem().string());
}

}  // namespace

Scene place(SceneDescription description) {
  check_camera(description);
  std::vector<glm::dvec3> points{description.eye};
  for (std::size_t i = 0; i < description.lights.size(); ++i) {
    check_light(description.lights[i], i);
    points.push_back(description.lights[i].position);
  }
  const Bounds box = mesh_bounds(description.mesh);
  Scene scene;
  scene.to_cube = fit_to_cube(box, points);
  check_distances(description, box, scene.to_cube);
  scene.camera = camera(description, scene.to_cube);
  for (const LightSource& light : description.lights)
    scene.lights.push_back({normalised(light.position, scene.to_cube), glm::vec3(light.intensity)});
  scene.name = std::move(description.name);
  scene.materials = std::move(description.materials);
  scene.mesh = std::move(description.mesh);
  normalise(scene.mesh, scene.to_cube);
  return scene;
}

Scene load_scene(const std::string& name_or_path, const SceneOptions& options) {
  SceneDescription description = describe(name_or_path);
  description.eye = options.eye.value_or(description.eye);
  description.target = options.target.value_or(description.target);
  description.up = options.up.value_or(description.up);
  description.fov_degrees = options.fov_degrees.value_or(description.fov_degrees);
  if (!options.lights.empty()) description.lights = options.lights;
  return place(std::move(description));
}

}  // namespace hitpipe::ref
