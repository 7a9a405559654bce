#include "sw_ref/render/whitted.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/cosine_rays.hpp"
#include "sw_ref/render/optics.hpp"
#include "sw_ref/render/shade.hpp"
#include "sw_ref/scene/noise.hpp"

namespace hitpipe::ref {
namespace {

float brightest(const glm::vec3& light) {
  return std::max(std::max(light.x, light.y), light.z);
}

/// What the directions of a task's random rays are drawn by: one number for each use and sample.
enum class Use : std::uint8_t { scattering, occlusion };
std::uint64_t key_of(std::uint64_t seed, const RayTask& task, Use use, int sample) {
  std::uint64_t key = mixed(seed + golden_step);
  for (const std::uint64_t part :
       {std::uint64_t{task.pixel}, std::uint64_t{task.depth} << 16U | task.source,
        static_cast<std::uint64_t>(use) << 32U | static_cast<std::uint64_t>(sample)})
    key = mixed((key ^ part) + golden_step);
  return key;
}

void check_samples(int samples, const char* what) {
  if (samples < 0 || samples > WhittedOptions::most_samples)
    throw std::invalid_argument(fmt::format("{} {} rays from a surface; allowed are 0 to {}", samples, what,
                                            WhittedOptions::most_samples));
}

}  // namespace

Whitted::Whitted(const Scene& scene, const WhittedOptions& options, const Surfaces* surfaces)
    : scene_(&scene),
      options_(options),
      causes_(ray_causes(scene, options)),
      own_surfaces_(scene.mesh),
      surfaces_(surfaces),
      end_(end_for(causes_)) {
  if (options.bounces < 0 || options.bounces > WhittedOptions::most_bounces)
    throw std::invalid_argument(
        fmt::format("{} bounces; allowed are 0 to {}", options.bounces, WhittedOptions::most_bounces));
  if (!(options.cutoff >= 0.0F))
    throw std::invalid_argument(fmt::format("cutoff {}; allowed is 0 or more", options.cutoff));
  check_samples(options.diffuse, "scattered");
  check_samples(options.occlusion, "occlusion");
  // A number behind the lights' is for occlusion.
  const std::size_t most_lights =
      std::size_t{std::numeric_limits<std::uint16_t>::max()} + (options.occlusion > 0 ? 0 : 1);
  if (scene.lights.size() > most_lights)
    throw std::invalid_argument(
        fmt::format("{} lights; at most {} are allowed", scene.lights.size(), most_lights));
  if (causes_.occlusion && !scene.mesh.triangles.empty())
    reach_ = static_cast<float>(occlusion_reach * mesh_bounds(scene.mesh).longest());
  if (options.diffuse > 1) options_.cutoff /= static_cast<float>(options.diffuse);
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
    if (!task.is_scattered()) pixel.add(task.weight * sky(task.ray.direction));
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
    const bool goes_on = secondary && task.depth != whitted.options_.bounces;
    const bool bends = goes_on && brightest(material.reflect + material.transmit) > 0.0F;
    if (!is_matt && !bends) return work;

    const Surfaces& surfaces = whitted.surfaces_ == nullptr ? whitted.own_surfaces_ : *whitted.surfaces_;
    const SurfacePoint point = surfaces.point(triangle, task.ray);
    work.surface_points = 1;
    if constexpr (scatters) {
      if (is_matt && !(shadow && whitted.causes_.occlusion)) pixel.add(diffuse * ambient(point));
    }
    if constexpr (shadow) {
      if (is_matt && whitted.causes_.occlusion)
        whitted.add_occlusion_rays(task, point, diffuse * ambient(point), next);
      if (is_matt) work.light_evaluations = whitted.add_shadow_rays(task, point, diffuse, next);
    }
    if constexpr (secondary) {
      if (is_matt && goes_on && whitted.causes_.scattered)
        whitted.add_scattered_rays(task, point, diffuse, next);
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

void Whitted::add_occlusion_rays(const RayTask& task, const SurfacePoint& point,
                                 const glm::vec3& ambient_light, std::vector<RayTask>& next) const {
  const int samples = task.depth == 0 ? options_.occlusion : 1;
  const glm::vec3 share = ambient_light / static_cast<float>(samples);
  const auto source = static_cast<std::uint16_t>(causes_.lights.size());
  for (int i = 0; i < samples; ++i)
    next.push_back({cosine_ray(point, key_of(options_.seed, task, Use::occlusion, i), reach_), share,
                    task.pixel, source, RayKind::shadow, task.depth});
}

void Whitted::add_scattered_rays(const RayTask& task, const SurfacePoint& point, const glm::vec3& diffuse,
                                 std::vector<RayTask>& next) const {
  const int samples = task.depth == 0 ? options_.diffuse : 1;
  const glm::vec3 share = diffuse / static_cast<float>(samples);
  if (!counts(share)) return;
  // A later ray of a path keeps its number, so that paths of a pixel part ways at every surface.
  const int first = task.is_scattered() ? task.source : RayTask::scattered;
  for (int i = 0; i < samples; ++i)
    next.push_back({cosine_ray(point, key_of(options_.seed, task, Use::scattering, i), Ray::infinite), share,
                    task.pixel, static_cast<std::uint16_t>(first + i), RayKind::secondary,
                    static_cast<std::uint8_t>(task.depth + 1)});
}

bool Whitted::counts(const glm::vec3& weight) const {
  return brightest(weight) > 0.0F && brightest(weight) >= options_.cutoff;
}

void Whitted::add_secondary_rays(const RayTask& task, const SurfacePoint& point, const Material& material,
                                 std::vector<RayTask>& next) const {
  const auto append = [&](const Ray& ray, const glm::vec3& weight, std::uint16_t source) {
    next.push_back(
        {ray, weight, task.pixel, source, RayKind::secondary, static_cast<std::uint8_t>(task.depth + 1)});
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
