#include "rays/scene/scene.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "host/reject.hpp"

namespace hitpipe::ref {
namespace {

std::string text(const glm::dvec3& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

bool is_finite_vector(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// v with length 1. It is scaled first, so that no square leaves the range of a double. v is finite and not
/// zero.
glm::dvec3 unit(const glm::dvec3& v) {
  return glm::normalize(v / largest(v));
}

void check_camera(const SceneDescription& scene) {
  if (!is_finite_vector(scene.eye)) reject(fmt::format("camera: eye {} must be finite", text(scene.eye)));
  if (!is_finite_vector(scene.target))
    reject(fmt::format("camera: target {} must be finite", text(scene.target)));
  if (!is_finite_vector(scene.up) || scene.up == glm::dvec3(0.0))
    reject(fmt::format("camera: up {} must be finite and not zero", text(scene.up)));
  if (scene.eye == scene.target)
    reject(fmt::format("camera: eye and target are both {}; they must differ", text(scene.eye)));
  if (!(scene.fov_degrees > 0.0 && scene.fov_degrees < 180.0))
    reject(fmt::format("camera: field of view of {} degrees; allowed is more than 0 and less than 180",
                       scene.fov_degrees));
}

/// A sum of parts may exceed 1 by the roundings of its binary32 terms.
constexpr float whole = 1.0F + 0x1p-20F;

void check_material(const Material& material, std::size_t number) {
  const auto check_part = [&](const char* name, const glm::vec3& part) {
    for (int k = 0; k < 3; ++k) {
      if (!(part[k] >= 0.0F && part[k] <= 1.0F))
        reject(fmt::format("material {}: {} {} must lie within 0 and 1", number, name, text(part)));
    }
  };
  check_part("albedo", material.albedo);
  check_part("reflect", material.reflect);
  check_part("transmit", material.transmit);
  const glm::vec3 sum = material.albedo + material.reflect + material.transmit;
  if (std::max({sum.x, sum.y, sum.z}) > whole)
    reject(fmt::format("material {}: albedo, reflect and transmit add up to {}; at most 1 is allowed", number,
                       text(sum)));
  if (!(material.refractive_index > 0.0F && std::isfinite(material.refractive_index)))
    reject(fmt::format("material {}: refractive index {} must be finite and more than 0", number,
                       material.refractive_index));
}

void check_light(const LightSource& light, std::size_t number) {
  if (light.kind == LightKind::sun) {
    if (!is_finite_vector(light.position) || light.position == glm::dvec3(0.0))
      reject(fmt::format("light {}: direction {} must be finite and not zero", number, text(light.position)));
  } else if (!is_finite_vector(light.position)) {
    reject(fmt::format("light {}: position {} must be finite", number, text(light.position)));
  }
  const glm::dvec3& i = light.intensity;
  if (!is_finite_vector(i) || i.x < 0.0 || i.y < 0.0 || i.z < 0.0)
    reject(fmt::format("light {}: intensity {} must be finite and not negative", number, text(i)));
}

/// One far point makes the cube so large that the mesh vanishes in it. The message names the farthest point.
void check_distances(const SceneDescription& scene, const Bounds& box, const Normalisation& fit) {
  const double part = box.longest() * fit.scale / 2.0;
  if (part >= smallest_mesh_part) return;
  if (scene.cube)
    reject(fmt::format("cube of {} around {}: the mesh has {:.2g} of its side; at least {} is needed",
                       scene.cube->half, text(scene.cube->centre), part, smallest_mesh_part));
  std::string blamed = fmt::format("camera: eye {}", text(scene.eye));
  double farthest = largest(scene.eye - box.centre());
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    if (scene.lights[i].kind == LightKind::sun) continue;
    const double distance = largest(scene.lights[i].position - box.centre());
    if (distance <= farthest) continue;
    farthest = distance;
    blamed = fmt::format("light {}: position {}", i, text(scene.lights[i].position));
  }
  reject(fmt::format(
      "{} is so far from the mesh that {:.2g} of the scene would be left for it; at least {} is needed",
      blamed, part, smallest_mesh_part));
}

/// Whether the point lies in a cube of so many times the side.
bool inside(const glm::dvec3& point, const Normalisation& fit, double sides) {
  constexpr double rounded = 0x1p-26;  // a point this far outside is on the cube in binary32
  const double most = cube_bound * sides + rounded;
  const glm::dvec3 p = glm::abs(fit.to_cube(point));
  return p.x <= most && p.y <= most && p.z <= most;
}

std::string text(const CubeChoice& cube) {
  return fmt::format("cube of {} around {}", cube.half, text(cube.centre));
}

/// A cube that is given must hold what rays begin at.
void check_inside(const SceneDescription& scene, const CubeChoice& cube, const Normalisation& fit) {
  if (!inside(scene.eye, fit, 1.0))
    reject(fmt::format("{}: ray 0 of the picture begins at the eye {}; rays must begin in the cube",
                       text(cube), text(scene.eye)));
  for (std::size_t i = 0; i < scene.lights.size(); ++i)
    if (scene.lights[i].kind == LightKind::point && !inside(scene.lights[i].position, fit, farthest_light))
      reject(fmt::format("{}: light {} lies at {}; allowed is up to 2^20 times as far from its middle",
                         text(cube), i, text(scene.lights[i].position)));
}

Normalisation fit(const SceneDescription& scene, const Bounds& box) {
  if (scene.cube) {
    const Normalisation chosen{scene.cube->centre, cube_bound / scene.cube->half, true};
    if (!inside(box.min, chosen, 1.0) || !inside(box.max, chosen, 1.0))
      reject(fmt::format("{}: the mesh reaches from {} to {}; all of it must lie in the cube",
                         text(*scene.cube), text(box.min), text(box.max)));
    check_inside(scene, *scene.cube, chosen);
    return chosen;
  }
  std::vector<glm::dvec3> points{scene.eye};
  for (const LightSource& light : scene.lights)
    if (light.kind == LightKind::point) points.push_back(light.position);
  const Normalisation fit = fit_to_cube(box, points);
  if (!std::isfinite(fit.scale))
    reject(fmt::format("scene: it reaches from {} to {}; it must be at least 1e-307 wide", text(box.min),
                       text(box.max)));
  return fit;
}

/// The light of a chosen cube may lie outside it.
glm::vec3 place_of(const LightSource& light, const Normalisation& fit) {
  if (light.kind == LightKind::sun) return unit(light.position);
  return fit.chosen ? glm::vec3(fit.to_cube(light.position)) : normalised(light.position, fit);
}

/// Half the height of an orthographic image in the cube. It is the same for a field of view at the target.
double half_height(const SceneDescription& scene, const Normalisation& fit) {
  const glm::dvec3 view = (scene.target - scene.eye) * fit.scale;
  const double largest_part = largest(view);
  const double distance = largest_part * glm::length(view / largest_part);
  const double half = distance * std::tan(glm::radians(scene.fov_degrees / 2.0));
  // Far beyond any picture, and far below where the sums of a ray's origin lose its place in the cube.
  constexpr double highest = 0x1p20;
  if (!(half > 0.0 && half <= highest))
    reject(
        fmt::format("camera: orthographic image of height {:.6g}; allowed is more than 0 and at most {:.6g}",
                    2.0 * half / fit.scale, 2.0 * highest / fit.scale));
  return half;
}

Camera camera(const SceneDescription& scene, const Normalisation& fit) {
  Camera out;
  out.eye = normalised(scene.eye, fit);
  out.forward = unit(scene.target - scene.eye);
  const glm::dvec3 up = unit(scene.up);
  const glm::dvec3 across = glm::cross(out.forward, up);
  constexpr double smallest_sine = 1e-6;  // below this, rounding errors would decide which way is up
  if (glm::length(across) < smallest_sine)
    reject(fmt::format("camera: up {} is parallel to the view from {} to {}; choose another up",
                       text(scene.up), text(scene.eye), text(scene.target)));
  out.right = unit(across);
  out.up = glm::cross(out.right, out.forward);
  out.tan_half_height = std::tan(glm::radians(scene.fov_degrees / 2.0));
  out.projection = scene.projection;
  if (scene.projection == Projection::orthographic) out.half_height = half_height(scene, fit);
  return out;
}

void check(const SceneDescription& scene) {
  for (std::size_t i = 0; i < scene.materials.size(); ++i) check_material(scene.materials[i], i);
  check_camera(scene);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) check_light(scene.lights[i], i);
}

/// All but the mesh.
Scene placed(SceneDescription& description, const Bounds& box, const Normalisation& to_cube) {
  Scene scene;
  scene.to_cube = to_cube;
  scene.mesh_part = box.longest() * to_cube.scale / (2.0 * cube_bound);
  scene.camera = camera(description, to_cube);
  for (const LightSource& light : description.lights)
    scene.lights.push_back({place_of(light, to_cube), glm::vec3(light.intensity), light.kind});
  scene.name = std::move(description.name);
  scene.stand_in_for = std::move(description.stand_in_for);
  scene.materials = std::move(description.materials);
  return scene;
}

}  // namespace

SceneDescription as_source(BuiltInDescription made) {
  std::vector<glm::dvec3> vertices(made.mesh.vertices.begin(), made.mesh.vertices.end());
  return {.name = std::move(made.name),
          .mesh = with_vertices(std::move(made.mesh), std::move(vertices)),
          .materials = std::move(made.materials),
          .eye = made.eye,
          .target = made.target,
          .up = made.up,
          .fov_degrees = made.fov_degrees,
          .lights = std::move(made.lights),
          .stand_in_for = std::move(made.stand_in_for),
          .projection = made.projection,
          .cube = made.cube};
}

Scene place(SceneDescription description) {
  check(description);
  const Bounds box = mesh_bounds(description.mesh);
  const Normalisation to_cube = fit(description, box);
  check_distances(description, box, to_cube);
  Scene scene = placed(description, box, to_cube);
  scene.mesh = normalise(std::move(description.mesh), scene.to_cube, scene.lost);
  return scene;
}

Scene place_in(SceneDescription description, const Normalisation& to_cube, Mesh mesh) {
  check(description);
  check_inside(description, {to_cube.offset, cube_bound / to_cube.scale}, to_cube);
  Scene scene = placed(description, mesh_bounds(description.mesh), {to_cube.offset, to_cube.scale, true});
  scene.mesh = std::move(mesh);
  return scene;
}

SceneDescription with_options(SceneDescription description, const SceneOptions& options) {
  description.eye = options.eye.value_or(description.eye);
  description.target = options.target.value_or(description.target);
  description.up = options.up.value_or(description.up);
  description.fov_degrees = options.fov_degrees.value_or(description.fov_degrees);
  description.projection = options.projection.value_or(description.projection);
  if (!options.lights.empty()) description.lights = options.lights;
  if (options.cube) description.cube = options.cube;
  return description;
}

}  // namespace hitpipe::ref
