#include "sim/operands/answer.hpp"

#include <algorithm>
#include <cmath>

#include "sw_ref/judge/triangle_test.hpp"
#include "sw_ref/scene/triangle_numbers.hpp"
#include "sw_ref/world/int_ray.hpp"
#include "sw_ref/world/int_triangle.hpp"

namespace hitpipe::sim {

namespace {

std::uint32_t number_in_file(const ref::IntScene& scene, std::uint32_t triangle) {
  return ref::TriangleNumbers(scene.mesh.mesh).of_source(scene.mesh.numbers[triangle]);
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
  Meeting made{.number = ref::TriangleNumbers(scene.mesh).of_source(triangle)};
  if (const auto point = ref::plane_point(scene.mesh.corners(triangle), asked.ray)) {
    made.distance = distance_of(point->t, asked, scene.to_cube);
    made.weights = point->weights;
  }
  return made;
}

std::optional<Meeting> meeting(const ref::IntScene& scene, const AskedRay& asked, std::uint32_t triangle) {
  if (triangle == ref::IntHit::none) return std::nullopt;
  Meeting made{.number = number_in_file(scene, triangle)};
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

Meeting meeting_at(const ref::IntScene& scene, const AskedRay& asked, std::uint32_t triangle,
                   std::int64_t t) {
  Meeting made = meeting(scene, asked, triangle).value();
  made.t = t;
  made.distance = distance_of(t, asked, scene);
  return made;
}

}  // namespace hitpipe::sim
