#include "sw_ref/render/whitted.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/judge/triangle_test.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/optics.hpp"
#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {
namespace {

float brightest(const glm::vec3& light) {
  return std::max(std::max(light.x, light.y), light.z);
}

}  // namespace

Whitted::Whitted(const Scene& scene, const WhittedOptions& options, const Surfaces* surfaces)
    : scene_(&scene),
      options_(options),
      causes_(ray_causes(scene, options.bounces)),
      own_surfaces_(scene.mesh),
      surfaces_(surfaces),
      end_(end_for(causes_)) {
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

Whitted::End Whitted::end_for(const RayCauses& causes) {
  if (causes.shadow()) return causes.secondary() ? end_where<true, true, true> : end_where<true, true, false>;
  if (causes.scatters)
    return causes.secondary() ? end_where<true, false, true> : end_where<true, false, false>;
  return causes.secondary() ? end_where<false, false, true> : end_where<false, false, false>;
}

template <bool scatters, bool shadow, bool secondary>
ShadeWork Whitted::end_where(const Whitted& whitted, const RayTask& task, std::uint32_t triangle,
                             LightSum& pixel, std::vector<RayTask>& next) {
  if constexpr (shadow) {
    if (task.kind == RayKind::shadow) {
      if (triangle == Hit::none) pixel.add(task.weight);
      return {};
    }
  }
  if (triangle == Hit::none) {
    pixel.add(task.weight * sky(task.ray.direction));
    return {};
  }
  ShadeWork work;
  if constexpr (scatters || secondary) {
    const Scene& scene = *whitted.scene_;
    const Mesh& mesh = scene.mesh;
    const Material& material = scene.materials[mesh.materials.empty() ? 0 : mesh.materials[triangle]];
    glm::vec3 diffuse(0.0F);
    if constexpr (scatters) diffuse = task.weight * material.albedo;
    const bool is_matt = scatters && brightest(diffuse) > 0.0F;
    const bool bends = secondary && task.depth != whitted.options_.bounces &&
                       brightest(material.reflect + material.transmit) > 0.0F;
    if (!is_matt && !bends) return work;

    const Surfaces& surfaces = whitted.surfaces_ == nullptr ? whitted.own_surfaces_ : *whitted.surfaces_;
    const SurfacePoint point = surfaces.point(triangle, task.ray);
    work.surface_points = 1;
    if constexpr (scatters) {
      if (is_matt) pixel.add(diffuse * ambient(point));
    }
    if constexpr (shadow) {
      if (is_matt) work.light_evaluations = whitted.add_shadow_rays(task, point, diffuse, next);
    }
    if constexpr (secondary) {
      if (bends) whitted.add_secondary_rays(task, point, material, next);
    }
  }
  return work;
}

std::uint32_t Whitted::add_shadow_rays(const RayTask& task, const SurfacePoint& point,
                                       const glm::vec3& diffuse, std::vector<RayTask>& next) const {
  const auto lights = static_cast<std::uint32_t>(causes_.lights.size());
  for (std::uint32_t i = 0; i < lights; ++i) {
    const Light& light = scene_->lights[causes_.lights[i]];
    const glm::vec3 brought = diffuse * direct(point, light);
    if (!(brightest(brought) > 0.0F)) continue;
    const auto ray = shadow_ray(point, light);
    if (!ray) continue;
    next.push_back({*ray, brought, task.pixel, static_cast<std::uint16_t>(i), RayKind::shadow, task.depth});
  }
  return lights;
}

void Whitted::add_secondary_rays(const RayTask& task, const SurfacePoint& point, const Material& material,
                                 std::vector<RayTask>& next) const {
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
