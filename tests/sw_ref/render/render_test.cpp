// The renderer: independent of threads and of the box test, counts add up, shadows fall where they should.
#include "sw_ref/render/render.hpp"

#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "sw_ref/exact/triangle_test.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/shade.hpp"
#include "tests/sw_ref/scene/error_message.hpp"

namespace hitpipe::ref {
namespace {

bool same_bits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(glm::vec3)) == 0;
}

class Render : public testing::Test {
 protected:
  Scene scene_ = load_scene("spheres");
  Bvh bvh_ = build_bvh(scene_.mesh);
};

TEST_F(Render, DoesNotDependOnThreads) {
  const RenderResult one = render(scene_, bvh_, 150, 101, 1, BoxTestKind::robust);
  for (const int threads : {2, 3, 8}) {
    const RenderResult many = render(scene_, bvh_, 150, 101, threads, BoxTestKind::robust);
    EXPECT_TRUE(same_bits(one.image, many.image)) << threads;
    EXPECT_EQ(one.triangles, many.triangles) << threads;
    EXPECT_EQ(one.counts, many.counts) << threads;
  }
}

TEST_F(Render, BoxTestsAgreeOnPaddedBoxes) {
  const RenderResult robust = render(scene_, bvh_, 128, 128, 2, BoxTestKind::robust);
  const RenderResult floats = render(scene_, bvh_, 128, 128, 2, BoxTestKind::float_slabs);
  EXPECT_EQ(robust.triangles, floats.triangles);
  EXPECT_TRUE(same_bits(robust.image, floats.image));
  EXPECT_EQ(robust.counts.rays_shadow, floats.counts.rays_shadow);
  EXPECT_GE(robust.counts.box_tests, floats.counts.box_tests);
}

TEST_F(Render, CountsAddUp) {
  const RenderResult result = render(scene_, bvh_, 96, 64, 2, BoxTestKind::robust);
  EXPECT_EQ(result.counts.rays_primary, 96U * 64U);
  const auto seen = static_cast<std::uint64_t>(
      std::count_if(result.triangles.begin(), result.triangles.end(), [](auto t) { return t != Hit::none; }));
  EXPECT_GT(seen, 96U * 64U / 2);
  EXPECT_LT(seen, 96U * 64U);
  EXPECT_GT(result.counts.rays_shadow, seen);
  EXPECT_LE(result.counts.rays_shadow, seen * scene_.lights.size());
  EXPECT_GT(result.counts.box_tests, result.counts.rays_primary + result.counts.rays_shadow);
  EXPECT_GT(result.counts.triangle_tests, seen);
}

TEST_F(Render, PixelsShowTheClosestTriangleAndSendItsShadowRays) {
  std::uint64_t shadow_rays = 0;
  const RenderResult result = render(scene_, bvh_, 16, 12, 1, BoxTestKind::robust);
  for (int y = 0; y < 12; ++y) {
    for (int x = 0; x < 16; ++x) {
      const Ray ray = primary_ray(scene_.camera, x, y, 16, 12);
      Hit best;
      for (std::uint32_t i = 0; i < scene_.mesh.triangles.size(); ++i)
        intersect_triangle(scene_.mesh, i, ray, best);
      EXPECT_EQ(result.triangles[static_cast<std::size_t>(16 * y + x)], best.triangle) << x << ", " << y;
      if (!best.found()) continue;
      const SurfacePoint point = surface_point(scene_.mesh, best.triangle, ray);
      for (const Light& light : scene_.lights) shadow_rays += shadow_ray(point, light) ? 1 : 0;
    }
  }
  EXPECT_EQ(result.counts.rays_shadow, shadow_rays);
}

TEST_F(Render, ColoursAreFiniteAndWithinTheRangeOfAnImage) {
  const RenderResult result = render(scene_, bvh_, 200, 200, 2, BoxTestKind::robust);
  float brightest = 0.0F;
  for (const glm::vec3& colour : result.image) {
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(colour[k], 0.0F);
      brightest = std::max(brightest, colour[k]);
    }
  }
  EXPECT_GT(brightest, 0.7F);
  EXPECT_LE(brightest, 1.0F);
}

TEST(RenderShadow, FallsBehindTheBlocker) {
  // A floor seen from above, and a small plate between it and the light.
  SceneDescription description;
  description.mesh.vertices = {{-1, 0, -1},          {-1, 0, 3},          {3, 0, -1},
                               {-0.2F, 0.5F, -0.2F}, {-0.2F, 0.5F, 0.2F}, {0.2F, 0.5F, 0.2F},
                               {0.2F, 0.5F, -0.2F}};
  description.mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}};
  description.materials = {{glm::vec3(0.5F)}};
  description.eye = {1.5, 3.0, 0.0};
  description.target = {0.0, 0.0, 0.0};
  description.fov_degrees = 1.0;
  description.lights = {{{0.0, 2.0, 0.0}, {1.0, 1.0, 1.0}}};
  SceneDescription unblocked = description;
  unblocked.mesh.triangles.resize(1);
  unblocked.mesh.vertices.resize(3);
  const auto middle = [](SceneDescription&& what) {
    const Scene scene = place(std::move(what));
    const RenderResult result = render(scene, build_bvh(scene.mesh), 3, 3, 1, BoxTestKind::robust);
    EXPECT_EQ(result.triangles[4], 0U);
    EXPECT_EQ(result.counts.rays_shadow, 9U);
    return result.image[4].x;
  };
  const float dark = middle(std::move(description));
  const float lit = middle(std::move(unblocked));
  EXPECT_NEAR(lit - dark, 0.5F, 1e-3F);  // albedo 0.5, light from straight above
}

TEST_F(Render, SizesAndThreadsOutOfRangeAreRejected) {
  const auto error = [&](int width, int height, int threads) {
    return error_message([&] { return render(scene_, bvh_, width, height, threads, BoxTestKind::robust); });
  };
  EXPECT_EQ(error(0, 5, 1), "image of 0 x 5 pixels; at least 1 x 1 is needed");
  EXPECT_EQ(error(5, -1, 1), "image of 5 x -1 pixels; at least 1 x 1 is needed");
  EXPECT_EQ(error(5, 5, 0), "0 threads; at least 1 is needed");
}

}  // namespace
}  // namespace hitpipe::ref
