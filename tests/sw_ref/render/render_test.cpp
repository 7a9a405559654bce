// The renderer does not depend on threads, tracer and tiles, its counts add up, and its shadows are in the
// right places.
#include "sw_ref/render/render.hpp"

#include <algorithm>
#include <cstring>
#include <mutex>
#include <numeric>
#include <random>

#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/shade.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref::render_test {
namespace {

bool same_bits(const std::vector<glm::vec3>& a, const std::vector<glm::vec3>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(glm::vec3)) == 0;
}

/// The balls of "spheres"; three are mirrors and three are glass.
Scene shiny_spheres() {
  Scene scene = load_scene("spheres");
  for (std::size_t i = 1; i < scene.materials.size(); ++i) {
    Material& material = scene.materials[i];
    material = {glm::vec3(0.6F, 0.5F, 0.4F)};
    if (i % 4 == 1) material = {glm::vec3(0.1F), glm::vec3(0.8F)};
    if (i % 4 == 2) material = {glm::vec3(0.0F), glm::vec3(0.15F), glm::vec3(0.8F), 1.5F};
  }
  return scene;
}

class Render : public testing::Test {
 protected:
  Scene scene_ = shiny_spheres();
  Bvh bvh_ = build_bvh(scene_.mesh);

  [[nodiscard]] RenderResult run(const RenderOptions& options, const TracerOptions& tracer = {}) const {
    return render(scene_, *make_tracer(scene_.mesh, bvh_, tracer), options);
  }
};

TEST_F(Render, PiecesOfTilesTogetherAreThePicture) {
  RenderOptions options{.width = 150, .height = 101};
  const RenderResult whole = run(options);
  EXPECT_EQ(tile_count(options), 20U);
  std::vector<glm::vec3> image(whole.image.size());
  RenderCounts counts;
  for (std::uint64_t number = 1; number <= 3; ++number) {
    options.tiles = {number, 3};
    const RenderResult piece = run(options);
    for (std::size_t i = 0; i < image.size(); ++i) image[i] += piece.image[i];
    counts += piece.counts;
    options.picture = false;
    const RenderResult counted = run(options);
    EXPECT_TRUE(counted.image.empty() && counted.triangles.empty());
    EXPECT_EQ(counted.counts, piece.counts);
    options.picture = true;
  }
  EXPECT_TRUE(same_bits(image, whole.image));
  EXPECT_EQ(counts, whole.counts);
}

TEST_F(Render, DoesNotDependOnThreads) {
  RenderOptions options{.width = 150, .height = 101, .threads = 1, .maps = true};
  const RenderResult one = run(options);
  for (const int threads : {2, 4, 1000}) {
    options.threads = threads;
    const RenderResult many = run(options);
    EXPECT_TRUE(same_bits(one.image, many.image)) << threads;
    EXPECT_EQ(one.triangles, many.triangles) << threads;
    EXPECT_EQ(one.counts, many.counts) << threads;
    EXPECT_EQ(one.box_tests, many.box_tests) << threads;
    EXPECT_EQ(one.depth, many.depth) << threads;
  }
}

TEST_F(Render, ImageAndRaysAreThoseOfEveryTracerAndTile) {
  const RenderResult expected = run({.width = 100, .height = 75, .threads = 2, .maps = true});
  for (const TracerOptions& tracer :
       {TracerOptions{.algorithm = Algorithm::slabs, .arithmetic = Arithmetic::binary32},
        {.algorithm = Algorithm::slabs_dist, .arithmetic = Arithmetic::binary32},
        {.algorithm = Algorithm::plu_dsa, .arithmetic = Arithmetic::binary64, .bundle = 64},
        {.algorithm = Algorithm::slabs_dsa, .arithmetic = Arithmetic::conservative, .bundle = 256}}) {
    const RenderResult result = run(
        {.width = 100, .height = 75, .threads = 2, .tile_side = tile_side_for(tracer.bundle), .maps = true},
        tracer);
    EXPECT_TRUE(same_bits(expected.image, result.image));
    EXPECT_EQ(expected.triangles, result.triangles);
    EXPECT_EQ(expected.depth, result.depth);
    EXPECT_EQ(expected.counts.primary.rays, result.counts.primary.rays);
    EXPECT_EQ(expected.counts.secondary.rays, result.counts.secondary.rays);
    EXPECT_EQ(expected.counts.shadow.rays, result.counts.shadow.rays);
  }
}

TEST_F(Render, CountsAddUp) {
  const RenderResult result = run({.width = 96, .height = 64, .threads = 2, .tile_side = 20, .maps = true});
  const RenderCounts& counts = result.counts;
  EXPECT_EQ(counts.primary.rays, 96U * 64U);
  const auto seen = static_cast<std::uint64_t>(
      std::count_if(result.triangles.begin(), result.triangles.end(), [](auto t) { return t != Hit::none; }));
  EXPECT_GT(seen, 96U * 64U / 2);
  EXPECT_LT(seen, 96U * 64U);
  EXPECT_GT(counts.secondary.rays, 500U);
  EXPECT_GT(counts.shadow.rays, seen);
  EXPECT_LE(counts.shadow.rays, (seen + counts.secondary.rays) * scene_.lights.size());
  const TraceCounts total = counts.total();
  EXPECT_EQ(total.rays, counts.primary.rays + counts.secondary.rays + counts.shadow.rays);
  EXPECT_EQ(total.box_tests, counts.primary.box_tests + counts.secondary.box_tests + counts.shadow.box_tests);
  EXPECT_GT(total.box_tests, total.rays);
  EXPECT_GT(total.triangle_tests, seen);
  // Every test belongs to some pixel.
  const auto sum = [](const std::vector<float>& map) { return std::accumulate(map.begin(), map.end(), 0.0); };
  EXPECT_EQ(sum(result.box_tests), static_cast<double>(total.box_tests));
  EXPECT_EQ(sum(result.triangle_tests), static_cast<double>(total.triangle_tests));
}

TEST_F(Render, MapsAreMadeOnlyWhereAsked) {
  const RenderResult result = run({.width = 8, .height = 8});
  EXPECT_TRUE(result.depth.empty());
  EXPECT_TRUE(result.box_tests.empty());
  EXPECT_TRUE(result.triangle_tests.empty());
}

/// Compares the renderer's batches with Whitted's tasks, done one at a time with all triangles.
TEST(ExtraBoxTests, AreThoseAboveTheReference) {
  RenderResult result;
  RenderResult reference;
  result.box_tests = {5.0F, 7.0F, 0.0F};
  reference.box_tests = {5.0F, 4.0F, 2.0F};
  EXPECT_EQ(extra_box_tests(result, reference), (std::vector<float>{0.0F, 3.0F, 0.0F}));
}

TEST_F(Render, PixelsShowTheClosestTriangleAndTheLightOfItsRays) {
  const RenderResult result = run({.width = 10, .height = 8, .maps = true});
  const Whitted whitted(scene_, {});
  std::uint64_t secondary_rays = 0;
  std::uint64_t shadow_rays = 0;
  for (std::uint32_t at = 0; at < 80; ++at) {
    LightSum light;
    std::vector<RayTask> tasks{
        whitted.primary(static_cast<int>(at) % 10, static_cast<int>(at) / 10, 10, 8, at)};
    while (!tasks.empty()) {
      const RayTask task = tasks.back();
      tasks.pop_back();
      Hit best;
      for (std::uint32_t i = 0; i < scene_.mesh.triangles.size(); ++i)
        intersect_triangle(scene_.mesh, i, task.ray, best);
      whitted.end(task, best.triangle, light, tasks);
      secondary_rays += task.kind == RayKind::secondary ? 1 : 0;
      shadow_rays += task.kind == RayKind::shadow ? 1 : 0;
      if (task.kind != RayKind::primary) continue;
      EXPECT_EQ(result.triangles[at], best.triangle) << at;
      if (best.found())
        EXPECT_NEAR(result.depth[at], best.t_low, 1e-6) << at;
      else
        EXPECT_EQ(result.depth[at], Ray::infinite) << at;
    }
    EXPECT_EQ(result.image[at], light.value()) << at;
  }
  EXPECT_GT(secondary_rays, 10U);
  EXPECT_EQ(result.counts.secondary.rays, secondary_rays);
  EXPECT_EQ(result.counts.shadow.rays, shadow_rays);
}

/// The parts of a material add up to 1, so no pixel is brighter than the brightest source of light.
TEST_F(Render, ColoursStayBelowTheLightThatThereIs) {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> part(0.0F, 1.0F);
  for (Material& material : scene_.materials) {
    for (int k = 0; k < 3; ++k) {
      const float sky_part = part(random);
      const float reflected = (1.0F - sky_part) * part(random);
      material.albedo[k] = sky_part;
      material.reflect[k] = reflected;
      material.transmit[k] = 1.0F - sky_part - reflected;
    }
    material.refractive_index = 0.5F + 1.5F * part(random);
  }
  const SurfacePoint facing_up{{}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  glm::vec3 most = ambient(facing_up);
  for (const Light& light : scene_.lights) most += light.intensity;
  most = glm::max(most, glm::max(sky({0.0F, -1.0F, 0.0F}), sky({0.0F, 1.0F, 0.0F})));
  const RenderResult result = run({.width = 64, .height = 64, .threads = 2, .light = {.bounces = 8}});
  float brightest = 0.0F;
  for (const glm::vec3& colour : result.image) {
    for (int k = 0; k < 3; ++k) {
      ASSERT_GE(colour[k], 0.0F);
      ASSERT_LE(colour[k], most[k] * (1.0F + 1e-5F));
      brightest = std::max(brightest, colour[k]);
    }
  }
  EXPECT_GT(brightest, 0.5F);
}

TEST_F(Render, SceneThatOnlyScattersSendsNoSecondaryRays) {
  for (Material& material : scene_.materials) material = {glm::vec3(0.5F)};
  EXPECT_EQ(run({.width = 40, .height = 40}).counts.secondary, TraceCounts{});
  scene_.lights.clear();
  EXPECT_EQ(run({.width = 40, .height = 40}).counts.shadow, TraceCounts{});
}

TEST_F(Render, BouncesLimitSecondaryRays) {
  std::uint64_t before = 0;
  for (const int bounces : {0, 1, 2, 5}) {
    const RenderResult result = run({.width = 40, .height = 40, .light = {.bounces = bounces}});
    EXPECT_EQ(result.counts.secondary.rays == 0, bounces == 0);
    EXPECT_TRUE(bounces == 0 || result.counts.secondary.rays > before) << bounces;
    before = result.counts.secondary.rays;
  }
}

TEST_F(Render, TellsHowFarItIs) {
  std::mutex telling;
  std::vector<double> shares;
  (void)run({.width = 64, .height = 33, .threads = 2, .tile_side = 16, .progress = [&](double share) {
               const std::scoped_lock lock(telling);
               shares.push_back(share);
             }});
  std::sort(shares.begin(), shares.end());
  ASSERT_EQ(shares.size(), 12U);
  for (std::size_t i = 0; i < shares.size(); ++i)
    EXPECT_DOUBLE_EQ(shares[i], static_cast<double>(i + 1) / 12.0);
}

/// The plate is at a height of 0.5.
SceneDescription floor_under_a_plate() {
  SceneDescription description;
  description.mesh.vertices = {{-1, 0, -1},          {-1, 0, 3},          {3, 0, -1},
                               {-0.2F, 0.5F, -0.2F}, {-0.2F, 0.5F, 0.2F}, {0.2F, 0.5F, 0.2F},
                               {0.2F, 0.5F, -0.2F}};
  description.mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {3, 5, 6}};
  description.materials = {{glm::vec3(0.5F)}};
  return description;
}

TEST(RenderShadow, FallsBehindTheBlocker) {
  // A floor seen from above, and a small plate between it and the light.
  SceneDescription description = floor_under_a_plate();
  description.eye = {1.5, 3.0, 0.0};
  description.target = {0.0, 0.0, 0.0};
  description.fov_degrees = 1.0;
  description.lights = {{{0.0, 2.0, 0.0}, {1.0, 1.0, 1.0}}};
  SceneDescription unblocked = description;
  unblocked.mesh.triangles.resize(1);
  unblocked.mesh.vertices.resize(3);
  const auto middle = [](SceneDescription&& what) {
    const Scene scene = place(std::move(what));
    const Bvh bvh = build_bvh(scene.mesh);
    const RenderResult result = render(scene, *make_tracer(scene.mesh, bvh, {}), {.width = 3, .height = 3});
    EXPECT_EQ(result.triangles[4], 0U);
    EXPECT_EQ(result.counts.shadow.rays, 9U);
    return result.image[4].x;
  };
  const float dark = middle(std::move(description));
  const float lit = middle(std::move(unblocked));
  EXPECT_NEAR(lit - dark, 0.5F, 1e-3F);  // albedo 0.5, light from straight above
}

TEST(RenderShadow, OfASunFallsAlongItsDirection) {
  // The plan of a floor under a plate at a height of 0.5. The sun stands in the east at 45 degrees, so the
  // shadow lies 0.5 to the west of the plate.
  SceneDescription description = floor_under_a_plate();
  description.eye = {0.0, 1.0, 0.0};
  description.up = {0.0, 0.0, -1.0};
  description.fov_degrees = 2.0 * std::atan(0.75) * 180.0 / 3.141592653589793;  // the image is 1.5 high
  description.projection = Projection::orthographic;
  description.lights = {{{1.0, 1.0, 0.0}, {1.0, 1.0, 1.0}, LightKind::sun}};
  const Scene scene = place(std::move(description));
  const Bvh bvh = build_bvh(scene.mesh);
  // Pixels lie 0.5 apart: x = -0.5, 0, 0.5.
  const RenderResult result =
      render(scene, *make_tracer(scene.mesh, bvh, {}), {.width = 3, .height = 3, .maps = true});
  constexpr std::size_t shadow = 3;
  constexpr std::size_t plate = 4;
  constexpr std::size_t lit = 5;
  EXPECT_EQ(result.triangles[shadow], 0U);
  EXPECT_NE(result.triangles[plate], 0U);
  EXPECT_EQ(result.triangles[lit], 0U);
  EXPECT_NEAR(result.image[lit].x - result.image[shadow].x, 0.5F * std::sqrt(0.5F), 1e-5F);
  EXPECT_NEAR(result.image[plate].x, result.image[lit].x, 1e-5F);
  const double scale = scene.to_cube.scale;
  EXPECT_NEAR(result.depth[shadow], 1.0 * scale, 1e-6);
  EXPECT_NEAR(result.depth[plate], 0.5 * scale, 1e-6);
}

TEST_F(Render, OptionsOutOfRangeRejected) {
  const auto error = [&](const RenderOptions& options) {
    return message_of<std::exception>([&] { (void)run(options); });
  };
  EXPECT_EQ(error({.width = 0, .height = 5}), "image of 0 x 5 pixels; at least 1 x 1 is needed");
  EXPECT_EQ(error({.width = 5, .height = -1}), "image of 5 x -1 pixels; at least 1 x 1 is needed");
  EXPECT_EQ(error({.threads = 0}), "0 threads; at least 1 is needed");
  EXPECT_EQ(error({.tile_side = 0}), "tile side 0; at least 1 is needed");
  EXPECT_EQ(error({.light = {.bounces = 99}}), "99 bounces; allowed are 0 to 64");
}

}  // namespace
}  // namespace hitpipe::ref::render_test
