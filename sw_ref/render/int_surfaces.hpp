// What the surfaces of an integer world look like.
#pragma once

#include <cstdint>

#include "hls/world/world_format.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/world/int_scene.hpp"
#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {

/// How far beside a surface its rays start: two units of the corners' grid, and at least as far as in the
/// float world. At one unit and less, many shadow rays hit the surface that they leave.
[[nodiscard]] double int_offset(const hls::WorldBits& bits);

/// Surfaces from the triangle and the exact weights of its corners, so that an image is the same on every
/// machine.
class IntSurfaces final : public Surfaces {
 public:
  /// The scene must outlive it.
  explicit IntSurfaces(const IntScene& scene) : scene_(&scene) {}
  /// Throws std::logic_error when the ray does not meet the triangle.
  [[nodiscard]] SurfacePoint point(std::uint32_t triangle, const Ray& ray) const override;

 private:
  const IntScene* scene_;
};

}  // namespace hitpipe::ref
