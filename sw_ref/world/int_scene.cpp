#include "sw_ref/world/int_scene.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/hierarchy/refit.hpp"
#include "sw_ref/scene/triangle_numbers.hpp"
#include "sw_ref/world/int_ray.hpp"

namespace hitpipe::ref {

double int_offset(const hls::WorldBits& bits) {
  return std::max(shadow_offset, std::ldexp(1.0, 3 - bits.coord));
}

namespace {

/// By triangle of the smaller mesh: the triangle of the larger one that has its number.
std::vector<std::uint32_t> kept_of(const Mesh& larger, const Mesh& smaller) {
  const TriangleNumbers before(larger);
  const TriangleNumbers after(smaller);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t i = 0; i < smaller.triangles.size(); ++i)
    kept.push_back(before.in_mesh(after.of_source(i)));
  return kept;
}

}  // namespace

IntScene int_scene(const Scene& scene, const hls::WorldBits& bits, const HierarchyOptions& hierarchy) {
  IntScene made{.bits = bits, .mesh = int_mesh(scene.mesh, bits.coord), .scene = scene, .bvh = {}};
  made.scene.mesh = made.mesh.mesh;
  if (made.mesh.triangles.empty()) return made;
  HierarchyOptions exact = hierarchy;
  exact.build.padding = 0.0F;
  made.bvh = exact.file.empty() ? build_bvh(made.mesh.mesh, exact.build)
                                : refitted(make_hierarchy(scene, exact).bvh, made.mesh.mesh,
                                           kept_of(scene.mesh, made.mesh.mesh));
  return made;
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
