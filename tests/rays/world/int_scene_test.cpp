// Pictures in the integer world: the same bits from every compiler, and near to the float picture.
#include "rays/world/int_scene.hpp"

#include <bit>
#include <memory>

#include <gtest/gtest.h>

#include "rays/trace/int_tracer.hpp"
#include "rays/tree/bvh_file.hpp"
#include "sw_ref/render/int_surfaces.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/world/int_error.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/temporary_folder.hpp"

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

/// A hierarchy of a file keeps its branches. On a coarse grid some of its triangles are gone.
TEST(IntScene, TakesTheHierarchyOfAFile) {
  const Scene scene = sim::hills();
  const sim::TemporaryFolder folder;
  const std::filesystem::path file =
      folder.write("hills.bvh", bvh_text(build_bvh(scene.mesh, {.max_triangles = 3}), scene.mesh));
  for (const int n : {4, 5, 20}) {
    const hls::WorldBits bits{n, 1, n, 0};
    const IntScene own = int_scene(scene, bits);
    const IntScene read = int_scene(scene, bits, {.file = file});
    EXPECT_EQ(read.mesh.mesh.dropped, own.mesh.mesh.dropped);
    EXPECT_EQ(n<20, read.mesh.lost.triangles> 0);
    EXPECT_EQ(read.bvh->order.size(), own.mesh.triangles.size());
    const auto picture = [](const IntScene& of) {
      const IntSurfaces surfaces(of);
      RenderOptions options;
      options.width = options.height = 24;
      options.surfaces = &surfaces;
      return hash_of(
          render(of.scene, *int_tracer(of.mesh, of.hierarchy(), {.world = of.bits}), options).image);
    };
    EXPECT_EQ(picture(read), picture(own)) << n;
  }
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
