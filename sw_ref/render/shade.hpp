// The light at the end of a ray: Lambert's law for lights with shadows, ambient light, a sky. It
// depends only on ray, triangle and scene. So every traversal that finds the same triangles sends the same
// shadow rays and computes the same image, bit for bit.
#pragma once

#include <cstdint>
#include <optional>

#include <glm/vec3.hpp>

#include "rays/mesh/ray.hpp"
#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

/// Distance from a surface to the origin of the rays that leave it, along the normal, in the [-1, 1] cube. It
/// is 128 units of the last place of binary32 near 1, so rounding cannot move the origin through the surface.
/// It is still below the width of a pixel.
constexpr double shadow_offset = 0x1p-17;

/// A place where a ray meets a triangle. Both normals are unit vectors on the ray's side of the surface.
struct SurfacePoint {
  glm::dvec3 position;
  glm::dvec3 normal;              ///< of the triangle's plane
  glm::dvec3 shading_normal;      ///< interpolated if the mesh has normals
  bool front = true;              ///< the ray meets the side whose corners run counterclockwise
  double offset = shadow_offset;  ///< how far beside the surface the rays that leave it start
};

/// Where a ray meets a triangle that a tracer has found for it. Thread-safe.
class Surfaces {
 public:
  virtual ~Surfaces() = default;
  [[nodiscard]] virtual SurfacePoint point(std::uint32_t triangle, const Ray& ray) const = 0;
};

/// By surface_point().
class FloatSurfaces final : public Surfaces {
 public:
  /// The mesh must outlive it.
  explicit FloatSurfaces(const Mesh& mesh, double offset = shadow_offset);
  [[nodiscard]] SurfacePoint point(std::uint32_t triangle, const Ray& ray) const override {
    SurfacePoint point = point_(*mesh_, triangle, ray);
    point.offset = offset_;
    return point;
  }

 private:
  const Mesh* mesh_;
  double offset_;  ///< how far beside a surface its rays start
  SurfacePoint (*point_)(const Mesh&, std::uint32_t, const Ray&);
};

/// The point of a triangle with these weights of its second and third corner, 0..1 together.
[[nodiscard]] SurfacePoint point_with_weights(const Mesh& mesh, std::uint32_t triangle, double v, double w,
                                              const glm::vec3& direction);

/// The point of `triangle` that the ray hits, computed in double and kept on the triangle.
[[nodiscard]] SurfacePoint surface_point(const Mesh& mesh, std::uint32_t triangle, const Ray& ray);
/// The same for a mesh without normals, and for one with normals.
[[nodiscard]] SurfacePoint flat_surface_point(const Mesh& mesh, std::uint32_t triangle, const Ray& ray);
[[nodiscard]] SurfacePoint smooth_surface_point(const Mesh& mesh, std::uint32_t triangle, const Ray& ray);

/// The point `offset` above the surface, on the ray's side for offset > 0. If that is outside the [-1, 1]
/// cube, it is moved onto the cube, as a float.
[[nodiscard]] glm::vec3 origin_beside(const SurfacePoint& point, double offset);

/// The ray from a surface to a light. A point light is at t = 1. The ray to a sun has no end, and its
/// direction is exactly the sun's. Nothing if the light is behind the surface, which is then dark without a
/// test.
[[nodiscard]] std::optional<Ray> shadow_ray(const SurfacePoint& point, const Light& light);

/// Linear radiance of the background.
[[nodiscard]] glm::vec3 sky(const glm::vec3& direction);

/// Light that comes from everywhere and casts no shadow.
[[nodiscard]] glm::vec3 ambient(const SurfacePoint& point);

/// The light that the point gets from an unblocked light, by Lambert's law.
[[nodiscard]] glm::vec3 direct(const SurfacePoint& point, const Light& light);

}  // namespace hitpipe::ref
