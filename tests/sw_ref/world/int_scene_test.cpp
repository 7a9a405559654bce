// Pictures in the integer world: the same bits from every compiler, and near to the float picture.
#include "sw_ref/world/int_scene.hpp"

#include <bit>
#include <memory>

#include <gtest/gtest.h>

#include "sw_ref/render/render.hpp"
#include "sw_ref/world/int_error.hpp"
#include "sw_ref/world/int_tracer.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::ref::int_scene_test {
namespace {

std::uint64_t hash_of(const std::vector<glm::vec3>& image) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const glm::vec3& pixel : image)
    for (int channel = 0; channel < 3; ++channel)
      hash = (hash ^ std::bit_cast<std::uint32_t>(pixel[channel])) * 0x100000001b3U;
  return hash;
}

TEST(IntScene, APictureHasTheSameBitsEverywhere) {
  const IntScene scene = int_scene(sim::hills(), {20, 1, 20, 0});
  const IntSurfaces surfaces(scene);
  const auto tracer = int_tracer(scene.mesh, scene.hierarchy(), {.world = scene.bits});
  RenderOptions options;
  options.width = options.height = 48;
  options.surfaces = &surfaces;
  EXPECT_EQ(hash_of(render(scene.scene, *tracer, options).image), 13816979283421970360U);
}

TEST(IntScene, RaysStartTwoUnitsBesideTheirSurface) {
  EXPECT_EQ(int_offset({20, 1, 20, 0}), 0x1p-17);
  EXPECT_EQ(int_offset({16, 1, 16, 0}), 0x1p-13);
  EXPECT_EQ(int_offset({24, 1, 24, 0}), shadow_offset);
}

TEST(IntError, FallsWithTheBits) {
  const Scene scene = sim::hills();
  const auto error = [&](int n) {
    return int_error(scene, {.world = {n, 1, n, 0}, .boxes = {{n, 1, 11, 0, n}}, .width = 48, .height = 48});
  };
  const IntError coarse = error(10);
  const IntError fine = error(22);
  EXPECT_GT(coarse.different_rays, 10 * fine.different_rays);
  EXPECT_GT(coarse.different_pixels, 10 * fine.different_pixels);
  EXPECT_GT(coarse.largest_movement, 1000 * fine.largest_movement);
  EXPECT_LT(fine.different_rays, fine.rays / 500);
  EXPECT_EQ(fine.lost_hits, 0U);
  EXPECT_EQ(fine.with.size(), 1U);
  EXPECT_GE(fine.with[0].box_tests, fine.exact.box_tests);
}

}  // namespace
}  // namespace hitpipe::ref::int_scene_test
