// The rays that a pixel needs and the light that they bring, after Whitted (1980): a shadow ray to each
// light, and a mirrored and a refracted ray from each surface that reflects and transmits. If they are asked
// for, rays in random directions gather what matt surfaces send to each other and find how open a place is.
// The caller traces the rays in any order and by any means. Everything depends only on task, triangle and
// scene, and light is summed in fixed point. So callers that find the same triangles send the same rays and
// compute the same image, bit for bit.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/mesh/ray.hpp"
#include "rays/scene/scene.hpp"
#include "rays/trace/tracer.hpp"
#include "sw_ref/render/ray_causes.hpp"
#include "sw_ref/render/shade.hpp"
#include "sw_ref/render/whitted_options.hpp"

namespace hitpipe::ref {

/// The light of a pixel: linear red, green and blue, summed in units of 2^-32, so that the order of the terms does not
/// count. A sum that reaches 2^32 - 2^-32 stays there.
class LightSum {
 public:
  /// Each component is cut to [0, 2^31] (NaN: 0) and rounded down to a unit.
  void add(const glm::vec3& light) {
    for (int k = 0; k < 3; ++k) {
      const auto units = static_cast<std::uint64_t>(unit * double{cut(light[k])});
      std::uint64_t& sum = sums_[static_cast<std::size_t>(k)];
      constexpr std::uint64_t most = std::numeric_limits<std::uint64_t>::max();
      sum = units > most - sum ? most : sum + units;
    }
  }

  /// The sum, with each component rounded to binary32 once.
  [[nodiscard]] glm::vec3 value() const {
    const auto linear = [](std::uint64_t sum) { return static_cast<float>(sum) / static_cast<float>(unit); };
    return {linear(sums_[0]), linear(sums_[1]), linear(sums_[2])};
  }

 private:
  static constexpr double unit = 0x1p32;

  static float cut(float x) {
    constexpr float most = 0x1p31F;
    return x > 0.0F ? (x < most ? x : most) : 0.0F;
  }

  std::array<std::uint64_t, 3> sums_{};
};

enum class RayKind : std::uint8_t {
  primary,
  secondary,  ///< mirrored, refracted or scattered
  shadow,
};

/// A ray to be traced for a pixel.
struct RayTask {
  static constexpr std::uint8_t mirrored = 0;
  static constexpr std::uint8_t refracted = 1;
  static constexpr std::uint8_t scattered = 2;  ///< this and above, a number for each path of WhittedOptions

  Ray ray;
  glm::vec3 weight{1.0F};   ///< its share of the pixel's light; for a shadow ray: the light that it brings
  std::uint32_t pixel = 0;  ///< the caller's number; random directions are drawn by it
  /// Of a shadow ray an index of RayCauses::lights, or their number for one that finds how open a place is;
  /// otherwise mirrored, refracted, or scattered and above.
  std::uint16_t source = 0;
  RayKind kind = RayKind::primary;
  std::uint8_t depth = 0;  ///< number of secondary rays from the eye to this ray, including this one

  [[nodiscard]] bool is_scattered() const { return kind == RayKind::secondary && source >= scattered; }
  [[nodiscard]] Query query() const { return kind == RayKind::shadow ? Query::any : Query::closest; }
};

/// The work done at the end of a ray.
struct ShadeWork {
  std::uint32_t surface_points = 0;     ///< computed
  std::uint32_t light_evaluations = 0;  ///< of direct light
};

class Whitted {
 public:
  /// The scene must outlive it, and the surfaces too; null: the float surfaces of the scene's mesh. Throws
  /// std::invalid_argument for options out of range, and for more lights than a task can number (2^16).
  Whitted(const Scene& scene, const WhittedOptions& options, const Surfaces* surfaces = nullptr);

  [[nodiscard]] const RayCauses& causes() const { return causes_; }

  /// The task of pixel (x, y), called `number`, of a width x height image. Random directions need numbers
  /// that say which pixel of the image it is.
  [[nodiscard]] RayTask primary(int x, int y, int width, int height, std::uint32_t number) const;

  /// To be called when the task's ray has ended at `triangle`, or Hit::none. Adds light to the task's pixel
  /// and appends the tasks that follow. A shadow ray is appended if the light is in front of the surface and
  /// would bring more than 0. If the eye is in the cube, the rays of all tasks are acceptable().
  ShadeWork end(const RayTask& task, std::uint32_t triangle, LightSum& pixel,
                std::vector<RayTask>& next) const {
    return end_(*this, task, triangle, pixel, next);
  }

 private:
  using End = ShadeWork (*)(const Whitted&, const RayTask&, std::uint32_t, LightSum&, std::vector<RayTask>&);

  /// end() for scenes that cause no other rays than these; chosen once.
  template <bool scatters, bool shadow, bool secondary>
  static ShadeWork end_where(const Whitted& whitted, const RayTask& task, std::uint32_t triangle,
                             LightSum& pixel, std::vector<RayTask>& next);
  [[nodiscard]] static End end_for(const RayCauses& causes);

  /// Returns how many times direct light was computed.
  std::uint32_t add_shadow_rays(const RayTask& task, const SurfacePoint& point, const glm::vec3& diffuse,
                                std::vector<RayTask>& next) const;
  void add_occlusion_rays(const RayTask& task, const SurfacePoint& point, const glm::vec3& ambient_light,
                          std::vector<RayTask>& next) const;
  void add_scattered_rays(const RayTask& task, const SurfacePoint& point, const glm::vec3& diffuse,
                          std::vector<RayTask>& next) const;
  void add_secondary_rays(const RayTask& task, const SurfacePoint& point, const Material& material,
                          std::vector<RayTask>& next) const;

  /// Whether a secondary ray of this weight is sent.
  [[nodiscard]] bool counts(const glm::vec3& weight) const;

  const Scene* scene_;
  WhittedOptions options_;
  RayCauses causes_;
  float reach_ = 0;  ///< of occlusion, in the cube
  FloatSurfaces own_surfaces_;
  const Surfaces* surfaces_;  ///< null: its own
  End end_;
};

}  // namespace hitpipe::ref
