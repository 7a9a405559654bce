// The rays that a scene can cause, by its materials and lights. The renderer leaves out the rest and makes
// the same picture with less work.
#include "sw_ref/render/ray_causes.hpp"

#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::ref::ray_causes_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr glm::vec3 none(0.0F);
const Material black{none};
const Material matt{glm::vec3(0.6F, 0.4F, 0.0F)};  // scatters no blue light
const Material mirror{none, glm::vec3(0.8F)};
const Material glass{none, none, glm::vec3(0.8F), 1.5F};
const Material everything{glm::vec3(0.3F), glm::vec3(0.3F), glm::vec3(0.3F), 1.2F};
const Light blue{{0.0F, 0.5F, 0.0F}, {0.0F, 0.0F, 1.0F}};

Scene one_triangle(const Material& material) {
  Scene scene;
  scene.mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.mesh.triangles = {{0, 1, 2}};
  scene.materials = {material};
  return scene;
}

TEST(RayCausesOf, MaterialsWithBounces) {
  for (const int bounces : {0, 5}) {
    const bool follows = bounces > 0;
    for (const auto& [material, scatters, mirrors, refracts] : {std::tuple(black, false, false, false),
                                                                {matt, true, false, false},
                                                                {mirror, false, true, false},
                                                                {glass, false, true, true},
                                                                {everything, true, true, true}}) {
      const RayCauses causes = ray_causes(one_triangle(material), {.bounces = bounces});
      EXPECT_EQ(causes.scatters, scatters);
      EXPECT_EQ(causes.mirrors, mirrors && follows);
      EXPECT_EQ(causes.refracts, refracts && follows);
      EXPECT_EQ(causes.secondary(), mirrors && follows);
      EXPECT_FALSE(causes.shadow());
      EXPECT_FALSE(causes.smooth);
    }
  }
}

TEST(RayCausesOf, LightsAreThoseWhoseColourSomeSurfaceScatters) {
  Scene scene = one_triangle(matt);
  scene.lights = {blue, {{}, none}, {{}, {0.0F, 0.1F, 0.0F}}, blue, {{}, glm::vec3(1.0F)}};
  EXPECT_THAT(ray_causes(scene, {}).lights, ElementsAre(2U, 4U));
  scene.materials[0] = everything;
  EXPECT_THAT(ray_causes(scene, {}).lights, ElementsAre(0U, 2U, 3U, 4U));
  scene.materials[0] = mirror;
  EXPECT_THAT(ray_causes(scene, {}).lights, IsEmpty());
}

TEST(RayCausesOf, MaterialsThatNoTriangleUsesAreNone) {
  Scene scene = one_triangle(black);
  scene.lights = {blue};
  scene.materials.push_back(everything);
  EXPECT_FALSE(ray_causes(scene, {}).scatters);
  scene.mesh.materials = {0};
  EXPECT_FALSE(ray_causes(scene, {}).secondary());
  scene.mesh.materials = {1};
  EXPECT_TRUE(ray_causes(scene, {}).secondary());
  EXPECT_TRUE(ray_causes(scene, {}).shadow());
}

/// The balls of "spheres", with the given materials in turn.
Scene balls(const std::vector<Material>& materials) {
  Scene scene = load_scene("spheres");
  for (std::size_t i = 0; i < scene.materials.size(); ++i)
    scene.materials[i] = materials[i % materials.size()];
  return scene;
}

RenderResult rendered(const Scene& scene, int threads = 2) {
  const Bvh bvh = build_bvh(scene.mesh);
  return render(scene, *make_tracer(scene.mesh, bvh, {}), {.width = 70, .height = 60, .threads = threads});
}

/// Adds what causes every kind of ray to a place that no ray reaches: a triangle under the floor, and a light
/// that only this triangle scatters.
Scene with_everything_unseen(Scene scene) {
  const float below = static_cast<float>(mesh_bounds(scene.mesh).min.y) - 0.01F;
  const auto first = static_cast<std::uint32_t>(scene.mesh.vertices.size());
  for (const glm::vec3& p : {glm::vec3(0.0F), {0.01F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.01F}})
    scene.mesh.vertices.push_back(p + glm::vec3(0.0F, below, 0.0F));
  if (!scene.mesh.normals.empty()) scene.mesh.normals.resize(scene.mesh.vertices.size(), {0.0F, 1.0F, 0.0F});
  scene.mesh.triangles.emplace_back(first, first + 1, first + 2);
  scene.mesh.materials.push_back(static_cast<std::uint8_t>(scene.materials.size()));
  scene.materials.push_back(everything);
  scene.lights.push_back(blue);
  return scene;
}

class Thrift : public testing::TestWithParam<std::tuple<std::vector<Material>, bool, bool>> {};

TEST_P(Thrift, MakesThePictureAndTheRaysOfARendererThatLeavesNothingOut) {
  const auto& [materials, lit, smooth] = GetParam();
  Scene scene = balls(materials);
  if (!lit) scene.lights.clear();
  if (!smooth) scene.mesh.normals.clear();
  const Scene whole = with_everything_unseen(scene);
  const RayCauses causes = ray_causes(scene, {});
  const RayCauses all = ray_causes(whole, {});
  ASSERT_TRUE(all.scatters && all.mirrors && all.refracts && all.shadow());
  const RenderResult thrifty = rendered(scene);
  const RenderResult lavish = rendered(whole);
  ASSERT_EQ(thrifty.image.size(), lavish.image.size());
  EXPECT_EQ(std::memcmp(thrifty.image.data(), lavish.image.data(), thrifty.image.size() * sizeof(glm::vec3)),
            0);
  EXPECT_EQ(thrifty.triangles, lavish.triangles);
  for (const RayKind kind : {RayKind::primary, RayKind::secondary, RayKind::shadow}) {
    RenderCounts a = thrifty.counts;
    RenderCounts b = lavish.counts;
    EXPECT_EQ(a.of(kind).rays, b.of(kind).rays);
  }
  EXPECT_EQ(thrifty.shading.queue_bytes, lavish.shading.queue_bytes);
  EXPECT_EQ(thrifty.shading.surface_points, lavish.shading.surface_points);
  EXPECT_LE(thrifty.shading.light_evaluations, lavish.shading.light_evaluations);
  EXPECT_EQ(thrifty.counts.secondary.rays > 0, causes.secondary());
  EXPECT_EQ(thrifty.counts.shadow.rays > 0, causes.shadow());
}

INSTANTIATE_TEST_SUITE_P(Scenes, Thrift,
                         testing::Combine(testing::Values(std::vector{black}, std::vector{matt},
                                                          std::vector{matt, mirror}, std::vector{matt, glass},
                                                          std::vector{matt, mirror, black, glass},
                                                          std::vector{mirror, glass}),
                                          testing::Bool(), testing::Bool()));

TEST(ShadingCounters, AreZeroForWhatTheSceneLacksAndGrowWithIt) {
  const ShadingCounts nothing = rendered(balls({black})).shading;
  EXPECT_EQ(nothing.surface_points, 0U);
  EXPECT_EQ(nothing.light_evaluations, 0U);
  EXPECT_EQ(nothing.queue_bytes_of(RayKind::primary), 32 * 32 * sizeof(RayTask));
  EXPECT_EQ(nothing.queue_bytes_of(RayKind::secondary), 0U);
  EXPECT_EQ(nothing.queue_bytes_of(RayKind::shadow), 0U);

  Scene unlit = balls({matt});
  const std::vector<Light> lights = std::exchange(unlit.lights, {});
  const RenderResult dark = rendered(unlit);
  const auto seen = static_cast<std::uint64_t>(
      std::count_if(dark.triangles.begin(), dark.triangles.end(), [](auto t) { return t != Hit::none; }));
  EXPECT_GT(seen, 0U);
  EXPECT_EQ(dark.shading.surface_points, seen);
  EXPECT_EQ(dark.shading.light_evaluations, 0U);
  EXPECT_EQ(dark.shading.queue_bytes_of(RayKind::shadow), 0U);

  Scene lit = balls({matt});
  for (std::size_t n = 1; n <= lights.size(); ++n) {
    lit.lights.assign(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(n));
    const ShadingCounts shading = rendered(lit).shading;
    EXPECT_EQ(shading.surface_points, seen);
    EXPECT_EQ(shading.light_evaluations, n * seen);
    EXPECT_EQ(shading.queue_bytes_of(RayKind::secondary), 0U);
    // A tile that shows only lit surface stays within what its pixels can send.
    EXPECT_GT(shading.queue_bytes_of(RayKind::shadow), (n - 1) * shading.queue_bytes_of(RayKind::primary));
    EXPECT_LE(shading.queue_bytes_of(RayKind::shadow), n * shading.queue_bytes_of(RayKind::primary));
  }

  Scene bent = balls({mirror});
  bent.lights.clear();
  const RenderResult shown = rendered(bent);
  EXPECT_GT(shown.shading.queue_bytes_of(RayKind::secondary), 0U);
  EXPECT_EQ(shown.shading.queue_bytes_of(RayKind::shadow), 0U);
  EXPECT_EQ(shown.shading.light_evaluations, 0U);
  // Each computed point of a mirror sends a ray.
  EXPECT_EQ(shown.shading.surface_points, shown.counts.secondary.rays);
}

TEST(ShadingCounters, DoNotDependOnThreads) {
  const Scene scene = balls({matt, mirror, black, glass});
  EXPECT_EQ(rendered(scene, 1).shading, rendered(scene, 8).shading);
}

}  // namespace
}  // namespace hitpipe::ref::ray_causes_test
