#include "rays/trace/int_fast_scene.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "rays/world/int_boxes.hpp"

namespace hitpipe::ref {

namespace {

constexpr int float_digits = std::numeric_limits<float>::digits;

/// Origins are below 2^(n-2+g), directions at most 2^S.
bool origins_fit(const hls::WorldBits& bits) {
  return bits.coord - 2 + bits.finer <= float_digits;
}
bool directions_fit(const hls::WorldBits& bits) {
  return bits.slope <= float_digits;
}

/// The boxes of the corners. An origin that does not fit is below 2^22 in units of corners, with n = 24, so it is
/// rounded by 1/8 at most. Boxes larger by 1/2 hold, seen from there, what the boxes hold seen from the origin. Their
/// planes are halves below 2^22, which binary32 has.
Bvh float_boxes(const IntMesh& mesh, const Bvh& bvh, const hls::WorldBits& bits) {
  const float padding = origins_fit(bits) ? 0.0F : 0.5F;
  const std::vector<IntBox> boxes = int_boxes(mesh, bvh);
  Bvh made = bvh;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      made.nodes[i].box.min[axis] = static_cast<float>(boxes[i].min[k]) - padding;
      made.nodes[i].box.max[axis] = static_cast<float>(boxes[i].max[k]) + padding;
    }
  return made;
}

Mesh::Corners float_corners(const IntTriangle& triangle) {
  const auto corner = [&](std::size_t i) {
    const auto& [x, y, z] = triangle.corners[i];
    return glm::vec3(x, y, z);
  };
  return {corner(0), corner(1), corner(2)};
}

}  // namespace

IntFastScene::IntFastScene(const IntMesh& mesh, const Bvh& bvh, const hls::WorldBits& bits, VectorWidth width)
    : scene_(fast_scene(
          float_boxes(mesh, bvh, bits),
          [&](std::uint32_t triangle) { return float_corners(mesh.triangles[triangle]); }, width)),
      origin_unit_(std::ldexp(1.0F, -bits.finer)),
      direction_unit_(std::ldexp(1.0F, -bits.slope)),
      length_unit_(std::ldexp(1.0, -bits.finer - bits.fraction)),
      allowance_(origins_fit(bits) && directions_fit(bits) ? 1.0F : 1.5F) {}

Ray IntFastScene::float_ray(const IntRay& ray) const {
  Ray made;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    made.origin[axis] = static_cast<float>(ray.origin[i]) * origin_unit_;
    made.direction[axis] = static_cast<float>(ray.direction[i]) * direction_unit_;
  }
  made.length = box_length(ray.length);
  return made;
}

}  // namespace hitpipe::ref
