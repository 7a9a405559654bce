// The terrain: a surface that nowhere folds, seen and lit at grazing angles.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/built_in_scenes.hpp"

namespace hitpipe::ref::terrain_test {
namespace {

glm::dvec3 normal_of(const Mesh& mesh, std::uint32_t triangle) {
  const Mesh::Corners c = mesh.corners(triangle);
  return glm::normalize(glm::cross(glm::dvec3(c.b) - glm::dvec3(c.a), glm::dvec3(c.c) - glm::dvec3(c.a)));
}

TEST(Terrain, FacesUpEverywhere) {
  for (const std::size_t triangles : {10'000U, 120'000U}) {
    const BuiltInDescription scene = terrain(triangles);
    for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i)
      ASSERT_GT(normal_of(scene.mesh, i).y, 0.0) << i;
  }
}

TEST(Terrain, PointsAreOutOfTheirGrid) {
  const BuiltInDescription scene = terrain(10'000);
  std::size_t in_line = 0;
  for (std::size_t i = 1; i < scene.mesh.vertices.size(); ++i)
    in_line += scene.mesh.vertices[i].z == scene.mesh.vertices[i - 1].z ? 1 : 0;
  EXPECT_LT(in_line, 3U);
}

TEST(Terrain, IsSeenAndLitAlongItsSurface) {
  const Scene scene = place(as_source(terrain(200'000)));
  const Bvh bvh = build_bvh(scene.mesh);
  RenderOptions options{.width = 64, .height = 64};
  std::size_t seen = 0;
  std::size_t grazing = 0;
  std::size_t flat = 0;
  std::size_t shadows = 0;
  std::size_t blocked = 0;
  options.traced = [&](RayKind kind, const TraceJob& job) {
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      const bool hit = job.triangles[i] != Hit::none;
      if (kind == RayKind::shadow) {
        ++shadows;
        blocked += hit ? 1 : 0;
        EXPECT_TRUE(job.rays[i].is_infinite());
        continue;
      }
      const glm::dvec3 direction(job.rays[i].direction);
      flat += std::abs(direction.y) < 0.45 ? 1 : 0;
      if (!hit) continue;
      ++seen;
      grazing += std::abs(glm::dot(direction, normal_of(scene.mesh, job.triangles[i]))) < 0.5 ? 1 : 0;
    }
  };
  (void)render(scene, *make_tracer(scene.mesh, bvh, {}), options);
  constexpr std::size_t pixels = 64 * 64;
  EXPECT_EQ(flat, pixels);
  // Land below, sky above.
  EXPECT_GT(seen, pixels / 2);
  EXPECT_LT(seen, pixels * 9 / 10);
  EXPECT_GT(grazing, seen / 2);
  EXPECT_GT(blocked, shadows / 20);
  EXPECT_LT(blocked, shadows * 3 / 4);
}

}  // namespace
}  // namespace hitpipe::ref::terrain_test
