// Which rays a pixel needs and what light they bring, after Whitted (1980): a shadow ray to each light, a
// mirrored and a refracted ray from each surface that reflects and transmits. The caller traces the rays, in
// any order and by any means. All of it depends on ray, triangle and scene alone and light is summed in fixed
// point, so callers that find the same triangles send the same rays and compute the same image, bit for bit.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "sw_ref/geometry/ray.hpp"
#include "sw_ref/render/light_sum.hpp"
#include "sw_ref/render/ray_causes.hpp"
#include "sw_ref/render/shade.hpp"
#include "sw_ref/scene/scene.hpp"
#include "sw_ref/traverse/query.hpp"

namespace hitpipe::ref {

enum class RayKind : std::uint8_t {
  primary,
  secondary,  ///< mirrored or refracted
  shadow,
};

/// A ray to be traced for a pixel.
struct RayTask {
  static constexpr std::uint8_t mirrored = 0;
  static constexpr std::uint8_t refracted = 1;

  Ray ray;
  glm::vec3 weight{1.0F};    ///< its share of the pixel's light; of a shadow ray: the light that it brings
  std::uint32_t pixel = 0;   ///< the caller's number
  std::uint16_t source = 0;  ///< of a shadow ray an index of RayCauses::lights, else mirrored or refracted
  RayKind kind = RayKind::primary;
  std::uint8_t depth = 0;  ///< secondary rays between the eye and its origin, itself counted

  [[nodiscard]] Query query() const { return kind == RayKind::shadow ? Query::any : Query::closest; }
};

struct WhittedOptions {
  static constexpr int most_bounces = 64;

  /// Secondary rays in a row, 0..most_bounces: what more would bring is dark.
  int bounces = 5;
  /// Secondary rays whose weight is below it in each component are not sent: what they would bring is dark.
  /// The parts of a material add up to 1 at most, so a pixel has at most 3 / cutoff rays of equal depth.
  float cutoff = 1.0F / 256.0F;
};

/// What came of the end of a ray.
struct ShadeWork {
  std::uint32_t surface_points = 0;     ///< computed
  std::uint32_t light_evaluations = 0;  ///< of direct light
};

class Whitted {
 public:
  /// The scene must outlive it. Throws std::invalid_argument for options out of range, and for more lights
  /// than a task can number (2^16).
  Whitted(const Scene& scene, const WhittedOptions& options);

  [[nodiscard]] const RayCauses& causes() const { return causes_; }

  /// The task of pixel (x, y), called `number`, of a width x height image.
  [[nodiscard]] RayTask primary(int x, int y, int width, int height, std::uint32_t number) const;

  /// Goes on after the task's ray ended at `triangle`, Hit::none if at none: adds light to the task's pixel
  /// and appends the tasks that follow. A shadow ray is appended when the light is in front of the surface
  /// and would bring more than 0. With the eye in the cube the rays of all tasks are acceptable().
  ShadeWork end(const RayTask& task, std::uint32_t triangle, LightSum& pixel,
                std::vector<RayTask>& next) const {
    return end_(*this, task, triangle, pixel, next);
  }

 private:
  using End = ShadeWork (*)(const Whitted&, const RayTask&, std::uint32_t, LightSum&, std::vector<RayTask>&);

  /// end() for scenes that cause no more than these; chosen once.
  template <bool scatters, bool shadow, bool secondary>
  static ShadeWork end_where(const Whitted& whitted, const RayTask& task, std::uint32_t triangle,
                             LightSum& pixel, std::vector<RayTask>& next);
  [[nodiscard]] static End end_for(const RayCauses& causes);

  /// How many lights were asked.
  std::uint32_t add_shadow_rays(const RayTask& task, const SurfacePoint& point, const glm::vec3& diffuse,
                                std::vector<RayTask>& next) const;
  void add_secondary_rays(const RayTask& task, const SurfacePoint& point, const Material& material,
                          std::vector<RayTask>& next) const;

  const Scene* scene_;
  WhittedOptions options_;
  RayCauses causes_;
  SurfacePoint (*surface_)(const Mesh&, std::uint32_t, const Ray&);
  End end_;
};

}  // namespace hitpipe::ref
