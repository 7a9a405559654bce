// Primary rays: one through the centre of each pixel.
#pragma once

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "sw_ref/geometry/ray.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// The infinite ray through pixel (x, y) of a width x height image; (0, 0) is at the upper left. Pixels are
/// square and the vertical field of view is the camera's. The direction has length 1, apart from rounding to
/// binary32.
[[nodiscard]] inline Ray primary_ray(const Camera& camera, int x, int y, int width, int height) {
  const double pixel = 2.0 * camera.tan_half_height / height;
  const double across = (x + 0.5 - 0.5 * width) * pixel;
  const double upward = (0.5 * height - y - 0.5) * pixel;
  const glm::dvec3 direction = glm::normalize(camera.forward + across * camera.right + upward * camera.up);
  return {camera.eye, glm::vec3(direction), Ray::infinite};
}

}  // namespace hitpipe::ref
