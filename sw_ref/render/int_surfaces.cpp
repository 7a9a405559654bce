#include "sw_ref/render/int_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/world/crossing.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::ref {

double int_offset(const hls::WorldBits& bits) {
  return std::max(shadow_offset, std::ldexp(1.0, 3 - bits.coord));
}

SurfacePoint IntSurfaces::point(std::uint32_t triangle, const Ray& ray) const {
  const hls::WorldBits& bits = scene_->bits;
  const auto crossing = int_crossing(int_ray(ray, bits), scene_->mesh.triangles[triangle], bits);
  if (!crossing) throw std::logic_error(fmt::format("triangle {} is not on the ray", triangle));
  const auto det = static_cast<double>(crossing->det);
  SurfacePoint point =
      point_with_weights(scene_->mesh.mesh, triangle, static_cast<double>(crossing->e[1]) / det,
                         static_cast<double>(crossing->e[2]) / det, ray.direction);
  point.offset = int_offset(bits);
  return point;
}

}  // namespace hitpipe::ref
