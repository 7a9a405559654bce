#include "sw_ref/render/cosine_rays.hpp"

#include <glm/geometric.hpp>

#include "sw_ref/scene/noise.hpp"

namespace hitpipe::ref {
namespace {

/// Below this a square of a length would be more rounding than length.
constexpr double least_square = 0x1p-30;

/// Each direction equally often: the first point of the cube that is in the ball.
glm::dvec3 on_sphere(Dice& dice) {
  for (;;) {
    glm::dvec3 p(0.0);
    for (int axis = 0; axis < 3; ++axis) p[axis] = dice.between(-1.0, 1.0);
    const double square = glm::dot(p, p);
    if (square <= 1.0 && square >= least_square) return glm::normalize(p);
  }
}

}  // namespace

glm::vec3 cosine_direction(const SurfacePoint& point, std::uint64_t key) {
  Dice dice(key);
  // The sphere of radius 1 that touches the surface is seen from there by the cosine.
  glm::dvec3 direction = point.shading_normal + on_sphere(dice);
  const double height = glm::dot(direction, point.normal);
  if (height < 0.0) direction -= 2.0 * height * point.normal;
  if (!(glm::dot(direction, direction) >= least_square)) direction = point.normal;
  return glm::vec3(glm::normalize(direction));
}

Ray cosine_ray(const SurfacePoint& point, std::uint64_t key, float length) {
  return {origin_beside(point, point.offset), cosine_direction(point, key), length};
}

}  // namespace hitpipe::ref
