#include "sw_ref/render/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

namespace hitpipe::ref {
namespace {

/// Where a line is inside the cube [-1, 1]: from <= t <= to, empty if from > to.
struct Inside {
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

Inside inside_cube(const glm::dvec3& start, const glm::dvec3& direction) {
  Inside inside;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0.0) {
      if (std::abs(start[axis]) > 1.0) inside.to = -1.0;
      continue;
    }
    const double face = direction[axis] > 0.0 ? 1.0 : -1.0;
    inside.from = std::max(inside.from, (-face - start[axis]) / direction[axis]);
    inside.to = std::min(inside.to, (face - start[axis]) / direction[axis]);
  }
  return inside;
}

}  // namespace

Ray ray_in_cube(const glm::dvec3& start, const glm::vec3& direction, double length) {
  // The direction is the rounded one, so that the ray goes on along its own line.
  const glm::dvec3 way(direction);
  const Inside inside = inside_cube(start, way);
  if (inside.from > inside.to || inside.from > length) {
    glm::vec3 corner(1.0F);
    for (int axis = 0; axis < 3; ++axis) corner[axis] = std::copysign(1.0F, direction[axis]);
    return {corner, direction, Ray::infinite};
  }
  return {glm::clamp(glm::vec3(start + inside.from * way), -1.0F, 1.0F), direction,
          static_cast<float>(length - inside.from)};
}

double start_in_cube(const glm::dvec3& start, const glm::vec3& direction) {
  const Inside inside = inside_cube(start, glm::dvec3(direction));
  return inside.from > inside.to ? 0.0 : inside.from;
}

std::optional<std::uint64_t> first_ray_outside(const Camera& camera, int width, int height) {
  if (camera.projection == Projection::perspective) return std::nullopt;  // its eye is in the cube
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 start = glm::abs(start_of(camera, x, y, width, height));
      if (start.x > 1.0 || start.y > 1.0 || start.z > 1.0)
        return static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(width) +
               static_cast<std::uint64_t>(x);
    }
  }
  return std::nullopt;
}

Ray parallel_ray(const glm::dvec3& start, const Camera& camera) {
  return ray_in_cube(start, glm::vec3(camera.forward), std::numeric_limits<double>::infinity());
}

}  // namespace hitpipe::ref
