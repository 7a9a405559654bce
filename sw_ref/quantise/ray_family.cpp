#include "sw_ref/quantise/ray_family.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {
namespace {

/// A margin for the errors of double arithmetic and one rounding to binary32, for numbers of about 1 at most.
constexpr double rounding = 0x1p-22;

float below(double x) {
  return std::nextafter(static_cast<float>(x), -Ray::infinite);
}
float above(double x) {
  return std::nextafter(static_cast<float>(x), Ray::infinite);
}

Aabb one_direction(const Camera& camera) {
  const glm::vec3 forward(camera.forward);
  return {forward, forward};
}

/// The box of the image's corners in the plane of an orthographic camera. If one of them is outside the cube,
/// some rays start where they enter it (parallel_ray).
Aabb parallel_origins(const Camera& camera, const ViewOptions& view) {
  const double upward = camera.half_height;
  const double across = upward * view.width / view.height;
  Aabb box;
  bool inside = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = camera.eye[axis];
    const double reach = across * std::abs(camera.right[axis]) + upward * std::abs(camera.up[axis]);
    inside = inside && std::abs(middle) + reach <= 1.0 - rounding;
    // Without reach every start has the eye's coordinate exactly.
    box.min[axis] = reach == 0.0 ? camera.eye[axis] : std::max(-1.0F, below(middle - reach - rounding));
    box.max[axis] = reach == 0.0 ? camera.eye[axis] : std::min(1.0F, above(middle + reach + rounding));
  }
  return inside ? box : Aabb{glm::vec3(-1.0F), glm::vec3(1.0F)};
}

/// The frustum's directions before they are made unit vectors are forward + a right + u up, |a| <= across,
/// |u| <= upward; their lengths lie in [1, longest]. A component that is not 0 keeps its sign.
Aabb primary_directions(const Camera& camera, const ViewOptions& view) {
  const double upward = camera.tan_half_height;
  const double across = upward * view.width / view.height;
  const double longest = std::sqrt(1.0 + across * across + upward * upward) + rounding;
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const double middle = camera.forward[axis];
    const double reach =
        across * std::abs(camera.right[axis]) + upward * std::abs(camera.up[axis]) + rounding;
    const double low = middle - reach;
    const double high = middle + reach;
    box.min[axis] = std::max(-1.0F, below(low < 0.0 ? low : low / longest));
    box.max[axis] = std::min(1.0F, above(high > 0.0 ? high : high / longest));
    // Components of a unit vector may be rounded to one unit of the last place beyond 1.
    if (box.min[axis] == -1.0F) box.min[axis] = below(-1.0);
    if (box.max[axis] == 1.0F) box.max[axis] = above(1.0);
  }
  return box;
}

RayFamily primary_family(const Camera& camera, const ViewOptions& view) {
  if (camera.projection == Projection::orthographic)
    return {RayKind::primary, parallel_origins(camera, view), one_direction(camera),
            "from the image of an orthographic camera, all in one direction"};
  return {RayKind::primary,
          {camera.eye, camera.eye},
          primary_directions(camera, view),
          "from the eye through the frustum of the image"};
}

/// Where rays leave surfaces: shadow_offset away from a point of a triangle, moved onto the cube
/// (origin_beside).
Aabb surface_origins(const Mesh& mesh) {
  const Bounds bounds = mesh_bounds(mesh);
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    const double reach = shadow_offset + rounding;
    box.min[axis] = std::max(-1.0F, below(bounds.min[axis] - reach));
    box.max[axis] = std::min(1.0F, above(bounds.max[axis] + reach));
  }
  return box;
}

Aabb all_directions() {
  return {glm::vec3(below(-1.0)), glm::vec3(above(1.0))};
}

}  // namespace

std::vector<RayFamily> ray_families(const Scene& scene, const ViewOptions& view) {
  const RayCauses causes = ray_causes(scene, view.light);
  std::vector<RayFamily> families{primary_family(scene.camera, view)};
  const Aabb surfaces = surface_origins(scene.mesh);
  if (causes.secondary()) {
    families.emplace_back() = {RayKind::secondary, surfaces, all_directions(),
                               causes.scattered ? "from the surfaces, which send rays anywhere"
                                                : "from the surfaces: mirrors and glass send rays anywhere"};
  }
  for (const std::uint32_t i : causes.lights) {
    const Light& light = scene.lights[i];
    if (light.kind == LightKind::sun) {
      families.push_back({RayKind::shadow,
                          surfaces,
                          {light.position, light.position},
                          fmt::format("from the surfaces to sun {}, all in one direction", i)});
      continue;
    }
    // light - origin in binary32: rounding is monotone, so the ends are the differences of the ends.
    families.push_back({RayKind::shadow,
                        surfaces,
                        {light.position - surfaces.max, light.position - surfaces.min},
                        fmt::format("from the surfaces to light {}", i),
                        RayEnd::light});
  }
  if (causes.occlusion) {
    families.emplace_back() = {RayKind::shadow, surfaces, all_directions(),
                               "from the surfaces to what is near, in any direction", RayEnd::reach};
  }
  return families;
}

}  // namespace hitpipe::ref
