#include "sw_ref/render/shade.hpp"

#include <algorithm>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace hitpipe::ref {
namespace {

/// x cut to [0, most]; 0 if x is NaN.
double part(double x, double most) {
  return x > 0.0 ? std::min(x, most) : 0.0;
}

/// The way from the point to the light; of a sun only its direction counts.
glm::dvec3 to_light(const SurfacePoint& point, const Light& light) {
  const glm::dvec3 place(light.position);
  return light.kind == LightKind::sun ? place : place - point.position;
}

/// `corners` are the triangle's.
template <bool smooth>
SurfacePoint point_at(const Mesh& mesh, std::uint32_t triangle, const Mesh::Corners& corners, double v,
                      double w, const glm::dvec3& direction) {
  const glm::dvec3 a(corners.a);
  const glm::dvec3 ab = glm::dvec3(corners.b) - a;
  const glm::dvec3 ac = glm::dvec3(corners.c) - a;
  const glm::dvec3 normal = glm::cross(ab, ac);
  const double determinant = glm::dot(direction, normal);
  SurfacePoint point;
  point.position = a + v * ab + w * ac;
  // The normal of a sliver can be zero in double although its exact area is not.
  const glm::dvec3 facing = determinant > 0.0 ? -normal : normal;
  point.normal = glm::normalize(facing == glm::dvec3(0.0) ? -direction : facing);
  point.shading_normal = point.normal;
  point.front = determinant <= 0.0;
  if constexpr (smooth) {
    const glm::uvec3& t = mesh.triangles[triangle];
    const glm::dvec3 shading =
        glm::normalize((1.0 - v - w) * glm::dvec3(mesh.normals[t.x]) + v * glm::dvec3(mesh.normals[t.y]) +
                       w * glm::dvec3(mesh.normals[t.z]));
    point.shading_normal = glm::dot(shading, point.normal) < 0.0 ? -shading : shading;
  }
  return point;
}

template <bool smooth>
SurfacePoint point_of(const Mesh& mesh, std::uint32_t triangle, const Ray& ray) {
  const Mesh::Corners corners = mesh.corners(triangle);
  const glm::dvec3 a(corners.a);
  const glm::dvec3 ab = glm::dvec3(corners.b) - a;
  const glm::dvec3 ac = glm::dvec3(corners.c) - a;
  const glm::dvec3 direction(ray.direction);
  const glm::dvec3 from_a = glm::dvec3(ray.origin) - a;
  const glm::dvec3 moment = glm::cross(direction, from_a);
  const double determinant = glm::dot(direction, glm::cross(ab, ac));
  // Barycentric coordinates of b and c. They are imprecise if the ray grazes the plane. Clamped, they still
  // give a point of the triangle, so nothing that is computed from it leaves the cube.
  const double v = part(glm::dot(moment, ac) / determinant, 1.0);
  const double w = part(-glm::dot(moment, ab) / determinant, 1.0 - v);
  return point_at<smooth>(mesh, triangle, corners, v, w, direction);
}

}  // namespace

SurfacePoint flat_surface_point(const Mesh& mesh, std::uint32_t triangle, const Ray& ray) {
  return point_of<false>(mesh, triangle, ray);
}

SurfacePoint smooth_surface_point(const Mesh& mesh, std::uint32_t triangle, const Ray& ray) {
  return point_of<true>(mesh, triangle, ray);
}

SurfacePoint surface_point(const Mesh& mesh, std::uint32_t triangle, const Ray& ray) {
  return mesh.normals.empty() ? flat_surface_point(mesh, triangle, ray)
                              : smooth_surface_point(mesh, triangle, ray);
}

FloatSurfaces::FloatSurfaces(const Mesh& mesh, double offset)
    : mesh_(&mesh),
      offset_(offset),
      point_(mesh.normals.empty() ? flat_surface_point : smooth_surface_point) {}

SurfacePoint point_with_weights(const Mesh& mesh, std::uint32_t triangle, double v, double w,
                                const glm::vec3& direction) {
  const auto point = mesh.normals.empty() ? point_at<false> : point_at<true>;
  return point(mesh, triangle, mesh.corners(triangle), v, w, glm::dvec3(direction));
}

glm::vec3 origin_beside(const SurfacePoint& point, double offset) {
  return glm::clamp(glm::vec3(point.position + offset * point.normal), -1.0F, 1.0F);
}

std::optional<Ray> shadow_ray(const SurfacePoint& point, const Light& light) {
  if (glm::dot(point.normal, to_light(point, light)) <= 0.0) return std::nullopt;
  const glm::vec3 origin = origin_beside(point, point.offset);
  if (light.kind == LightKind::sun) return Ray{origin, light.position, Ray::infinite};
  const glm::vec3 direction = light.position - origin;
  if (direction == glm::vec3(0.0F)) return std::nullopt;
  return Ray{origin, direction, 1.0F};
}

glm::vec3 sky(const glm::vec3& direction) {
  constexpr glm::vec3 horizon(0.86F, 0.82F, 0.76F);
  constexpr glm::vec3 zenith(0.30F, 0.48F, 0.70F);
  const float height = std::clamp(0.3F + 1.4F * direction.y / glm::length(direction), 0.0F, 1.0F);
  return glm::mix(horizon, zenith, height);
}

glm::vec3 ambient(const SurfacePoint& point) {
  constexpr glm::vec3 from_sky(0.17F, 0.20F, 0.25F);
  constexpr glm::vec3 from_ground(0.12F, 0.10F, 0.08F);
  return glm::mix(from_ground, from_sky, static_cast<float>(0.5 + 0.5 * point.shading_normal.y));
}

glm::vec3 direct(const SurfacePoint& point, const Light& light) {
  const glm::dvec3 way = glm::normalize(to_light(point, light));
  return light.intensity * static_cast<float>(std::max(0.0, glm::dot(point.shading_normal, way)));
}

}  // namespace hitpipe::ref
