// The city: its boxes lie along the axes, and so do its rays.
#include <cmath>
#include <set>
#include <tuple>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/built_in_scenes.hpp"

namespace hitpipe::ref::city_test {
namespace {

constexpr std::size_t fewest = 100'000;

/// What the rays of one kind do.
struct RaysOfAKind {
  std::uint64_t count = 0;
  std::uint64_t blocked = 0;
  std::uint64_t with_end = 0;
  std::set<std::tuple<float, float, float>> directions;
};

struct RaysOfACity {
  RaysOfAKind primary;
  RaysOfAKind secondary;
  RaysOfAKind shadow;
};

RaysOfACity rays_of(const Scene& scene) {
  const Bvh bvh = build_bvh(scene.mesh);
  RaysOfACity rays;
  RenderOptions options{.width = 48, .height = 48};
  options.traced = [&](RayKind kind, const TraceJob& job) {
    RaysOfAKind& of = kind == RayKind::primary  ? rays.primary
                      : kind == RayKind::shadow ? rays.shadow
                                                : rays.secondary;
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      const Ray& ray = job.rays[i];
      ++of.count;
      of.blocked += job.triangles[i] != Hit::none ? 1 : 0;
      of.with_end += ray.is_infinite() ? 0 : 1;
      of.directions.emplace(ray.direction.x, ray.direction.y, ray.direction.z);
    }
  };
  (void)render(scene, *make_tracer(scene.mesh, bvh, {}), options);
  return rays;
}

using Directions = std::set<std::tuple<float, float, float>>;

TEST(City, FacesAreExactlyAcrossAnAxis) {
  const Scene scene = place(as_source(city(fewest)));
  for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) {
    const Mesh::Corners c = scene.mesh.corners(i);
    int planes = 0;
    for (int axis = 0; axis < 3; ++axis) planes += c.a[axis] == c.b[axis] && c.b[axis] == c.c[axis] ? 1 : 0;
    ASSERT_EQ(planes, 1) << i;
  }
}

/// Binary32 holds such coordinates exactly, so faces that should lie in one plane do.
TEST(City, CornersLieOnAGridOfAnEighthOfAMetre) {
  const BuiltInDescription scene = city(fewest);
  for (const glm::vec3& v : scene.mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) ASSERT_EQ(v[axis] * 8.0F, std::floor(v[axis] * 8.0F));
}

TEST(City, FromAboveHasOnlyVerticalRays) {
  const RaysOfACity rays = rays_of(place(as_source(city(fewest))));
  EXPECT_EQ(rays.primary.count, 48U * 48U);
  EXPECT_EQ(rays.primary.directions, (Directions{{0.0F, -1.0F, 0.0F}}));
  EXPECT_EQ(rays.shadow.directions, (Directions{{0.0F, 1.0F, 0.0F}}));
  EXPECT_EQ(rays.primary.with_end + rays.shadow.with_end, 0U);
  EXPECT_EQ(rays.secondary.count, 0U);
  // The city fills the image. What the camera sees, the sun sees too.
  EXPECT_EQ(rays.primary.blocked, rays.primary.count);
  EXPECT_EQ(rays.shadow.count, rays.primary.count);
  EXPECT_EQ(rays.shadow.blocked, 0U);
}

TEST(City, AtASlantHasShadowRaysAlongAxesAndShadows) {
  const Scene scene = place(as_source(city_oblique(fewest)));
  const RaysOfACity rays = rays_of(scene);
  const glm::vec3 forward(scene.camera.forward);
  EXPECT_EQ(rays.primary.directions, (Directions{{forward.x, forward.y, forward.z}}));
  EXPECT_EQ(rays.shadow.directions, (Directions{{0.0F, 1.0F, 0.0F}, {1.0F, 0.0F, 0.0F}}));
  EXPECT_EQ(rays.secondary.count, 0U);
  EXPECT_GT(rays.primary.blocked, rays.primary.count * 9 / 10);
  EXPECT_GT(rays.shadow.blocked, rays.shadow.count / 50);
  EXPECT_LT(rays.shadow.blocked, rays.shadow.count / 2);
}

/// More triangles add details; they do not move houses.
TEST(City, DetailLeavesThePlanAsItIs) {
  const auto land = [](std::size_t triangles) {
    const BuiltInDescription scene = city(triangles);
    const Bounds bounds = mesh_bounds(scene.mesh);
    return std::tuple(bounds.min.x, bounds.max.x, bounds.min.y, bounds.max.y, bounds.min.z, bounds.max.z);
  };
  EXPECT_EQ(land(fewest), land(300'000));
}

}  // namespace
}  // namespace hitpipe::ref::city_test
