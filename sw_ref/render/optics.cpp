#include "sw_ref/render/optics.hpp"

#include <cmath>

#include <glm/geometric.hpp>

namespace hitpipe::ref {
namespace {

/// An interpolated normal can face away from the ray although the triangle does not.
glm::dvec3 bending_normal(const SurfacePoint& point, const glm::dvec3& arriving) {
  return glm::dot(arriving, point.shading_normal) < 0.0 ? point.shading_normal : point.normal;
}

glm::dvec3 mirrored(const glm::dvec3& arriving, const glm::dvec3& normal) {
  return arriving - 2.0 * glm::dot(arriving, normal) * normal;
}

/// `ratio`: refractive index of this side over the other side's.
std::optional<glm::dvec3> refracted(const glm::dvec3& arriving, const glm::dvec3& normal, double ratio) {
  const double cosine = -glm::dot(arriving, normal);
  const double other_cosine_squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
  if (!(other_cosine_squared >= 0.0)) return std::nullopt;
  return glm::normalize(ratio * arriving + (ratio * cosine - std::sqrt(other_cosine_squared)) * normal);
}

}  // namespace

Ray mirrored_ray(const SurfacePoint& point, const glm::vec3& direction) {
  const glm::dvec3 arriving = glm::normalize(glm::dvec3(direction));
  glm::dvec3 leaving = mirrored(arriving, bending_normal(point, arriving));
  if (!(glm::dot(leaving, point.normal) > 0.0)) leaving = mirrored(arriving, point.normal);
  return {origin_beside(point, point.offset), glm::vec3(leaving), Ray::infinite};
}

std::optional<Ray> refracted_ray(const SurfacePoint& point, const glm::vec3& direction, float index) {
  const glm::dvec3 arriving = glm::normalize(glm::dvec3(direction));
  const double ratio = point.front ? 1.0 / index : double{index};
  auto leaving = refracted(arriving, bending_normal(point, arriving), ratio);
  if (leaving && !(glm::dot(*leaving, point.normal) < 0.0))
    leaving = refracted(arriving, point.normal, ratio);
  if (!leaving) return std::nullopt;
  return Ray{origin_beside(point, -point.offset), glm::vec3(*leaving), Ray::infinite};
}

}  // namespace hitpipe::ref
