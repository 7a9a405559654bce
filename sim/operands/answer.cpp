#include "sim/operands/answer.hpp"

#include <algorithm>
#include <cmath>

#include "rays/exact/exact_triangle.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_triangle.hpp"

namespace hitpipe::sim {

namespace {

Meeting named(const ref::Mesh& mesh, std::uint32_t triangle) {
  const ref::TriangleNumbers numbers(mesh);
  const std::uint32_t number = numbers.of_source(triangle);
  return {.number = number, .face = numbers.face_of(number)};
}

double distance_of(double t, const AskedRay& asked, const ref::Normalisation& to_cube) {
  return (t + asked.outside) / to_cube.scale;
}

/// T is a distance along the major axis, in units of the origin's grid.
double distance_of(std::int64_t t, const AskedRay& asked, const ref::IntScene& scene) {
  const glm::vec3& direction = asked.ray.direction;
  const double major = std::max({std::abs(direction.x), std::abs(direction.y), std::abs(direction.z)});
  const double in_cube = std::ldexp(static_cast<double>(t), -scene.bits.fraction) /
                         static_cast<double>(scene.bits.largest_point());
  return distance_of(in_cube / major, asked, scene.scene.to_cube);
}

}  // namespace

std::optional<Meeting> meeting(const ref::Scene& scene, const AskedRay& asked, std::uint32_t triangle) {
  if (triangle == ref::Hit::none) return std::nullopt;
  Meeting made = named(scene.mesh, triangle);
  if (const auto point = ref::plane_point(scene.mesh.corners(triangle), asked.ray)) {
    made.distance = distance_of(point->t, asked, scene.to_cube);
    made.weights = point->weights;
  }
  return made;
}

std::optional<Meeting> meeting(const ref::IntScene& scene, const AskedRay& asked, std::uint32_t triangle) {
  if (triangle == ref::IntHit::none) return std::nullopt;
  Meeting made = named(scene.mesh.mesh, triangle);
  const auto crossing =
      ref::int_crossing(ref::int_ray(asked.ray, scene.bits), scene.mesh.triangles[triangle], scene.bits);
  if (!crossing) return made;
  made.t = crossing->t;
  made.distance = distance_of(crossing->t, asked, scene);
  const auto weight = [&](std::size_t corner) {
    return static_cast<double>(crossing->e[corner]) / static_cast<double>(crossing->det);
  };
  made.weights = {weight(0), weight(1), weight(2)};
  return made;
}

std::optional<Meeting> meeting_of_number(const ref::IntScene& scene, const AskedRay& asked,
                                         std::uint32_t number) {
  return meeting(scene, asked, ref::TriangleNumbers(scene.mesh.mesh).in_mesh(number));
}

Meeting meeting_at(const ref::IntScene& scene, const AskedRay& asked, std::uint32_t number, std::int64_t t) {
  Meeting made = meeting_of_number(scene, asked, number).value_or(Meeting{.number = number});
  made.t = t;
  made.distance = distance_of(t, asked, scene);
  return made;
}

}  // namespace hitpipe::sim
