#include "sw_ref/render/whitted.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/exact/triangle_test.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/optics.hpp"
#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {
namespace {

float brightest(const glm::vec3& light) {
  return std::max(std::max(light.x, light.y), light.z);
}

}  // namespace

Whitted::Whitted(const Scene& scene, const WhittedOptions& options) : scene_(&scene), options_(options) {
  if (options.bounces < 0 || options.bounces > WhittedOptions::most_bounces)
    throw std::invalid_argument(
        fmt::format("{} bounces; allowed are 0 to {}", options.bounces, WhittedOptions::most_bounces));
  if (!(options.cutoff >= 0.0F))
    throw std::invalid_argument(fmt::format("cutoff {}; allowed is 0 or more", options.cutoff));
  constexpr std::size_t most_lights = 1 + std::size_t{std::numeric_limits<std::uint16_t>::max()};
  if (scene.lights.size() > most_lights)
    throw std::invalid_argument(
        fmt::format("{} lights; at most {} are allowed", scene.lights.size(), most_lights));
}

RayTask Whitted::primary(int x, int y, int width, int height, std::uint32_t number) const {
  RayTask task;
  task.ray = primary_ray(scene_->camera, x, y, width, height);
  task.pixel = number;
  return task;
}

void Whitted::end(const RayTask& task, std::uint32_t triangle, LightSum& pixel,
                  std::vector<RayTask>& next) const {
  if (task.kind == RayKind::shadow) {
    if (triangle == Hit::none) pixel.add(task.weight);
    return;
  }
  if (triangle == Hit::none) {
    pixel.add(task.weight * sky(task.ray.direction));
    return;
  }
  const Mesh& mesh = scene_->mesh;
  const Material& material = scene_->materials[mesh.materials.empty() ? 0 : mesh.materials[triangle]];
  const SurfacePoint point = surface_point(mesh, triangle, task.ray);
  const glm::vec3 diffuse = task.weight * material.albedo;
  pixel.add(diffuse * ambient(point));
  for (std::size_t i = 0; i < scene_->lights.size(); ++i) {
    const Light& light = scene_->lights[i];
    const glm::vec3 brought = diffuse * direct(point, light);
    if (!(brightest(brought) > 0.0F)) continue;
    const auto ray = shadow_ray(point, light);
    if (!ray) continue;
    next.push_back({*ray, brought, task.pixel, static_cast<std::uint16_t>(i), RayKind::shadow, task.depth});
  }

  if (task.depth == options_.bounces) return;
  const auto append = [&](const Ray& ray, const glm::vec3& weight, std::uint16_t source) {
    next.push_back(
        {ray, weight, task.pixel, source, RayKind::secondary, static_cast<std::uint8_t>(task.depth + 1)});
  };
  const auto counts = [&](const glm::vec3& weight) {
    return brightest(weight) > 0.0F && brightest(weight) >= options_.cutoff;
  };
  glm::vec3 mirrored = task.weight * material.reflect;
  if (brightest(material.transmit) > 0.0F) {
    const glm::vec3 passing = task.weight * material.transmit;
    const auto ray = refracted_ray(point, task.ray.direction, material.refractive_index);
    if (!ray) mirrored += passing;
    if (ray && counts(passing)) append(*ray, passing, RayTask::refracted);
  }
  if (counts(mirrored)) append(mirrored_ray(point, task.ray.direction), mirrored, RayTask::mirrored);
}

}  // namespace hitpipe::ref
