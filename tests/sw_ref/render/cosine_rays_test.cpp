// Rays in random directions: how they are distributed, how many follow from a hit, and the light that they
// bring.
#include "sw_ref/render/cosine_rays.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "host/text.hpp"
#include "rays/exact/box_referee.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/render.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::ref::cosine_rays_test {
namespace {

SurfacePoint on_floor(const glm::dvec3& shading = {0.0, 1.0, 0.0}) {
  return {{0.25, 0.0, 0.0}, {0.0, 1.0, 0.0}, shading, true};
}

/// With a density of cos / pi the mean of a direction is 2/3 of the normal, the mean of cos^2 is 1/2, and the
/// azimuth is even.
TEST(CosineDirection, IsDistributedByTheCosine) {
  constexpr int count = 200'000;
  glm::dvec3 sum(0.0);
  double squares = 0;
  std::array<int, 8> octants{};
  std::array<int, 10> slices{};  // of cos^2, each equally probable
  for (std::uint64_t key = 0; key < count; ++key) {
    const glm::dvec3 direction(cosine_direction(on_floor(), key));
    ASSERT_GE(direction.y, 0.0);
    ASSERT_NEAR(glm::length(direction), 1.0, 1e-6);
    sum += direction;
    const double square = direction.y * direction.y;
    squares += square;
    ++slices.at(std::min<std::size_t>(9, static_cast<std::size_t>(10.0 * square)));
    ++octants.at((direction.x > 0 ? 1U : 0U) + (direction.z > 0 ? 2U : 0U) +
                 (std::abs(direction.x) > std::abs(direction.z) ? 4U : 0U));
  }
  const glm::dvec3 mean = sum / double{count};
  EXPECT_NEAR(mean.x, 0.0, 5e-3);
  EXPECT_NEAR(mean.y, 2.0 / 3.0, 3e-3);
  EXPECT_NEAR(mean.z, 0.0, 5e-3);
  EXPECT_NEAR(squares / count, 0.5, 3e-3);
  // Five standard deviations.
  for (const int slice : slices) EXPECT_NEAR(slice, count / 10.0, 5 * std::sqrt(count * 0.09));
  for (const int octant : octants) EXPECT_NEAR(octant, count / 8.0, 5 * std::sqrt(count * 0.11));
}

TEST(CosineDirection, LeavesItsSideOfTheTriangleWhateverTheShadingNormal) {
  for (std::uint64_t key = 0; key < 20'000; ++key) {
    const double slant = static_cast<double>(key % 100) / 100.0;
    const SurfacePoint point = on_floor(glm::normalize(glm::dvec3(1.0, 1.0 - slant, 0.5)));
    const Ray ray = cosine_ray(point, key, 0.5F);
    EXPECT_GE(ray.direction.y, 0.0F);
    EXPECT_NEAR(glm::length(ray.direction), 1.0F, 1e-6F);
    EXPECT_EQ(ray.origin, glm::vec3(0.25F, 0x1p-17F, 0.0F));
    EXPECT_EQ(ray.length, 0.5F);
    EXPECT_TRUE(acceptable(ray));
  }
}

/// A closed room: matt walls of the same albedo all around the eye.
Scene room(float albedo) {
  Scene scene;
  const auto wall = [&](const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v) {
    const auto base = static_cast<std::uint32_t>(scene.mesh.vertices.size());
    scene.mesh.vertices.insert(scene.mesh.vertices.end(), {corner, corner + u, corner + u + v, corner + v});
    scene.mesh.triangles.insert(scene.mesh.triangles.end(),
                                {{base, base + 1, base + 2}, {base, base + 2, base + 3}});
  };
  for (const float side : {-0.9F, 0.9F})
    for (int axis = 0; axis < 3; ++axis) {
      glm::vec3 corner(-0.9F), u(0.0F), v(0.0F);
      corner[axis] = side;
      u[(axis + 1) % 3] = v[(axis + 2) % 3] = 1.8F;
      wall(corner, u, v);
    }
  scene.materials = {{glm::vec3(albedo)}};
  scene.camera.eye = {0.011F, 0.023F, 0.017F};  // no ray meets an edge
  scene.camera.tan_half_height = 1.2;
  return scene;
}

/// A floor of two triangles and nothing else.
Scene floor(float albedo) {
  Scene scene = room(albedo);
  scene.mesh.vertices = {
      {-0.9F, -0.5F, -0.9F}, {-0.9F, -0.5F, 0.9F}, {0.9F, -0.5F, 0.9F}, {0.9F, -0.5F, -0.9F}};
  scene.mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.camera.forward = {0.0, -1.0, 0.0};
  scene.camera.up = {0.0, 0.0, -1.0};
  return scene;
}

RenderResult rendered(const Scene& scene, const WhittedOptions& light, int threads = 1, int tile_side = 32) {
  const Bvh bvh = build_bvh(scene.mesh);
  return render(scene, *make_tracer(scene.mesh, bvh, {}),
                {.width = 40, .height = 40, .threads = threads, .tile_side = tile_side, .light = light});
}

double mean_of(const RenderResult& result) {
  double sum = 0;
  for (const glm::vec3& pixel : result.image) sum += pixel.x;
  return sum / static_cast<double>(result.image.size());
}

TEST(Diffuse, RaysAreAsManyAtTheFirstHitAndOneLater) {
  const Scene scene = room(0.5F);
  constexpr std::uint64_t pixels = 40 * 40;
  EXPECT_EQ(rendered(scene, {}).counts.secondary.rays, 0U);
  EXPECT_EQ(rendered(scene, {.bounces = 0, .diffuse = 3}).counts.secondary.rays, 0U);
  EXPECT_EQ(rendered(scene, {.bounces = 1, .diffuse = 3}).counts.secondary.rays, 3 * pixels);
  EXPECT_EQ(rendered(scene, {.bounces = 4, .diffuse = 3}).counts.secondary.rays, 4 * 3 * pixels);
  // 0.5^8 is below the cutoff, and a pixel's rays share the light of one.
  EXPECT_EQ(rendered(scene, {.bounces = 64, .diffuse = 1}).counts.secondary.rays, 8 * pixels);
  EXPECT_EQ(rendered(scene, {.bounces = 64, .diffuse = 4}).counts.secondary.rays, 8 * 4 * pixels);
}

/// Walls of one albedo a with light L of their own see each other as L, so the sum is L (1 + a + a^2 ...).
TEST(Diffuse, LightOfAClosedRoomIsTheGeometricSeries) {
  const Scene scene = room(0.5F);
  const double own = mean_of(rendered(scene, {}));
  EXPECT_NEAR(mean_of(rendered(scene, {.bounces = 1, .diffuse = 8})), 1.5 * own, 0.02 * own);
  EXPECT_NEAR(mean_of(rendered(scene, {.bounces = 5, .diffuse = 8})), (2.0 - 1.0 / 32) * own, 0.02 * own);
}

TEST(Diffuse, RaysThatLeaveTheSceneBringNothing) {
  const Scene scene = floor(0.8F);
  const RenderResult usual = rendered(scene, {});
  const RenderResult diffuse = rendered(scene, {.diffuse = 2});
  EXPECT_GT(diffuse.counts.secondary.rays, 0U);
  EXPECT_EQ(diffuse.image, usual.image);
}

TEST(Diffuse, PathsOfAPixelPartWays) {
  const Scene scene = room(0.9F);
  const Whitted whitted(scene, {.bounces = 3, .diffuse = 4});
  std::vector<RayTask> tasks{whitted.primary(7, 9, 40, 40, 9 * 40 + 7)};
  std::set<std::array<float, 3>> directions;
  LightSum light;
  for (std::size_t i = 0; i < tasks.size(); ++i) {
    const RayTask task = tasks[i];
    Hit hit;
    for (std::uint32_t t = 0; t < scene.mesh.triangles.size(); ++t)
      intersect_triangle(scene.mesh, t, task.ray, hit);
    whitted.end(task, hit.triangle, light, tasks);
    directions.insert({task.ray.direction.x, task.ray.direction.y, task.ray.direction.z});
  }
  EXPECT_EQ(tasks.size(), 1U + 3 * 4);
  EXPECT_EQ(directions.size(), tasks.size());
}

TEST(Occlusion, RaysEndAtAShareOfTheSceneAndAddUpToTheAmbientLight) {
  const Scene open = floor(0.8F);
  std::uint64_t hits = 0;
  const RenderResult usual = rendered(open, {});
  for (const std::uint32_t triangle : usual.triangles) hits += triangle == Hit::none ? 0 : 1;
  const RenderResult occluded = rendered(open, {.occlusion = 5});
  EXPECT_EQ(occluded.counts.shadow.rays, 5 * hits);
  for (std::size_t i = 0; i < usual.image.size(); ++i)
    EXPECT_NEAR(occluded.image[i].x, usual.image[i].x, 1e-6F);

  const Scene scene = room(0.8F);
  RenderOptions options{.width = 16, .height = 16, .light = {.occlusion = 2}};
  options.traced = [](RayKind kind, const TraceJob& job) {
    if (kind != RayKind::shadow) return;
    for (const Ray& ray : job.rays) EXPECT_NEAR(ray.length, occlusion_reach * 1.8, 1e-6);
  };
  const Bvh bvh = build_bvh(scene.mesh);
  EXPECT_GT(render(scene, *make_tracer(scene.mesh, bvh, {}), options).counts.shadow.rays, 500U);
}

/// In the corners of a room ambient light gets darker; in the middle of a wall nothing is near.
TEST(Occlusion, DarkensCornersAndNothingElse) {
  const Scene scene = room(0.8F);
  const RenderResult usual = rendered(scene, {});
  const RenderResult occluded = rendered(scene, {.occlusion = 16});
  const auto at = [](const RenderResult& result, std::size_t x, std::size_t y) {
    return result.image[40 * y + x].x;
  };
  EXPECT_NEAR(at(occluded, 20, 20), at(usual, 20, 20), 1e-6F);
  double darkest = 1;
  for (std::size_t i = 0; i < usual.image.size(); ++i) {
    EXPECT_LE(occluded.image[i].x, usual.image[i].x + 1e-6F);
    darkest = std::min(darkest, double{occluded.image[i].x} / usual.image[i].x);
  }
  EXPECT_LT(darkest, 0.7);
  EXPECT_GT(darkest, 0.05);
}

/// Bits of the image and counts.
std::uint64_t hash_of(const RenderResult& result) {
  return host::fnv1a(std::as_bytes(std::span(result.image)), host::fnv1a_start);
}

TEST(RandomDirections, AreTheSameForAnyThreadsTilesAndTracer) {
  const Scene scene = load_scene("spheres");
  const WhittedOptions light{.bounces = 3, .diffuse = 2, .occlusion = 2};
  const RenderResult one = rendered(scene, light);
  for (const int tile_side : {7, 32, 64}) {
    const RenderResult other = rendered(scene, light, 3, tile_side);
    EXPECT_EQ(other.image, one.image) << tile_side;
    EXPECT_EQ(other.counts.total().rays, one.counts.total().rays);
    EXPECT_EQ(other.counts.total().box_tests, one.counts.total().box_tests);
  }
  WhittedOptions seeded = light;
  seeded.seed = 2;
  const RenderResult other = rendered(scene, seeded);
  EXPECT_NE(other.image, one.image);
  EXPECT_NEAR(mean_of(other), mean_of(one), 0.02 * mean_of(one));
}

/// On every machine and compiler.
TEST(RandomDirections, GiveTheKnownPicture) {
  const Scene scene = load_scene("spheres");
  EXPECT_EQ(hash_of(rendered(scene, {})), 17495052792114355231U);
  EXPECT_EQ(hash_of(rendered(scene, {.diffuse = 1, .occlusion = 2})), 6804114486362865790U);
}

}  // namespace
}  // namespace hitpipe::ref::cosine_rays_test
