// The reading room: boxes under a sun that stands straight above.
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/built_in_scenes.hpp"

namespace hitpipe::ref::reading_room_test {
namespace {

constexpr std::size_t fewest_of_a_room = 60'000;

TEST(ReadingRoom, IsClosedButForItsSkylights) {
  const Scene scene = place(as_source(reading_room(fewest_of_a_room)));
  const Bvh bvh = build_bvh(scene.mesh);
  std::uint64_t sky = 0;
  std::uint64_t primary = 0;
  std::uint64_t shadow = 0;
  std::uint64_t lit = 0;
  std::uint64_t oblique = 0;
  RenderOptions options{.width = 64, .height = 48};
  options.traced = [&](RayKind kind, const TraceJob& job) {
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      const bool free = job.triangles[i] == Hit::none;
      if (kind == RayKind::primary) {
        ++primary;
        sky += free ? 1 : 0;
      } else if (kind == RayKind::shadow) {
        ++shadow;
        lit += free ? 1 : 0;
        oblique += job.rays[i].direction == glm::vec3(0.0F, 1.0F, 0.0F) ? 0 : 1;
      }
    }
  };
  (void)render(scene, *make_tracer(scene.mesh, bvh, {}), options);
  EXPECT_EQ(primary, 64U * 48U);
  EXPECT_GT(sky, 0U);
  EXPECT_LT(sky, primary / 10);
  EXPECT_EQ(oblique, 0U);
  EXPECT_GT(lit, shadow / 20);
  EXPECT_LT(lit, shadow / 2);
}

/// Binary32 holds such coordinates exactly, so faces that should lie in one plane do.
TEST(ReadingRoom, WallsAndShelvesLieOnAGrid) {
  const BuiltInDescription scene = reading_room(fewest_of_a_room);
  std::uint64_t on_grid = 0;
  for (const glm::vec3& v : scene.mesh.vertices) on_grid += v.x * 64.0F == std::floor(v.x * 64.0F) ? 1 : 0;
  EXPECT_GT(on_grid, scene.mesh.vertices.size() * 95 / 100);
}

}  // namespace
}  // namespace hitpipe::ref::reading_room_test
