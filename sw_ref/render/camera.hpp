// Primary rays: one through the centre of each pixel.
// A perspective camera sends them from its eye, an orthographic one from its image plane.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "rays/mesh/ray.hpp"
#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

/// The ray from `start` in this direction, in the cube [-1, 1]. `length` is its largest t from there, 0 or
/// more, or infinite. A ray that starts outside the cube starts where it enters it, with the length that is
/// left. If it does not get there, it starts at a corner from which it leaves the cube, so it meets nothing
/// either.
[[nodiscard]] Ray ray_in_cube(const glm::dvec3& start, const glm::vec3& direction, double length);

/// The t from `start` at which ray_in_cube() lets the ray start; 0 for a ray that never gets there.
[[nodiscard]] double start_in_cube(const glm::dvec3& start, const glm::vec3& direction);

/// Where the ray of a pixel begins on the image plane of an orthographic camera; it can be outside the cube.
[[nodiscard]] inline glm::dvec3 start_of(const Camera& camera, int x, int y, int width, int height) {
  const double side = 2.0 * camera.half_height / height;
  return glm::dvec3(camera.eye) + (x + 0.5 - 0.5 * width) * side * camera.right +
         (0.5 * height - y - 0.5) * side * camera.up;
}

/// The infinite ray of an orthographic camera from a point of its plane, in the cube. All such rays have the
/// direction `forward`, rounded to binary32, and go as ray_in_cube() says.
[[nodiscard]] Ray parallel_ray(const glm::dvec3& start, const Camera& camera);

/// The infinite ray through pixel (x, y) of a width x height image; (0, 0) is at the upper left. Pixels are
/// square, and the height of the image is the camera's. The direction has length 1, apart from rounding to
/// binary32.
[[nodiscard]] inline Ray primary_ray(const Camera& camera, int x, int y, int width, int height) {
  if (camera.projection == Projection::orthographic) {
    return parallel_ray(start_of(camera, x, y, width, height), camera);
  }
  const double pixel = 2.0 * camera.tan_half_height / height;
  const double across = (x + 0.5 - 0.5 * width) * pixel;
  const double upward = (0.5 * height - y - 0.5) * pixel;
  const glm::dvec3 direction = glm::normalize(camera.forward + across * camera.right + upward * camera.up);
  return {camera.eye, glm::vec3(direction), Ray::infinite};
}

/// The number of the first pixel, counted along the rows, whose ray begins outside the cube [-1, 1]; nothing if
/// all begin inside.
[[nodiscard]] std::optional<std::uint64_t> first_ray_outside(const Camera& camera, int width, int height);

/// Distance in the cube from the eye, or from the image plane of an orthographic camera.
[[nodiscard]] inline double depth_of(const Camera& camera, const glm::dvec3& position) {
  const glm::dvec3 eye(camera.eye);
  return camera.projection == Projection::orthographic ? glm::dot(position - eye, camera.forward)
                                                       : glm::distance(position, eye);
}

}  // namespace hitpipe::ref
