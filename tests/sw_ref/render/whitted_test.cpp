// Mirrored and refracted rays computed by hand, the rays that follow from a hit, and the light that they
// bring.
#include "sw_ref/render/whitted.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/optics.hpp"
#include "sw_ref/render/shade.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref::whitted_test {
namespace {

const double root_half = std::sqrt(0.5);
const SurfacePoint on_floor{{0.25, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}, true};
const glm::vec3 slanting(glm::dvec3(root_half, -root_half, 0.0));

void expect_near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
  EXPECT_LT(glm::distance(a, b), tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

TEST(MirroredRay, LeavesAtTheAngleAtWhichItArrives) {
  const Ray ray = mirrored_ray(on_floor, slanting);
  expect_near(ray.direction, {root_half, root_half, 0.0}, 1e-7);
  EXPECT_EQ(ray.origin, glm::vec3(0.25F, 0x1p-17F, 0.0F));
  EXPECT_TRUE(ray.is_infinite());
}

TEST(RefractedRay, FollowsSnellsLawAndTheSameWayBack) {
  const auto in = refracted_ray(on_floor, slanting, 1.5F);
  ASSERT_TRUE(in);
  const double sine = root_half / 1.5;
  expect_near(in->direction, {sine, -std::sqrt(1.0 - sine * sine), 0.0}, 1e-7);
  EXPECT_EQ(in->origin, glm::vec3(0.25F, -0x1p-17F, 0.0F));
  EXPECT_TRUE(in->is_infinite());
  SurfacePoint from_inside = on_floor;
  from_inside.front = false;
  const auto out = refracted_ray(from_inside, in->direction, 1.5F);
  ASSERT_TRUE(out);
  expect_near(out->direction, slanting, 1e-6);
}

TEST(RefractedRay, GoesStraightOnWhereNothingRefracts) {
  for (const bool front : {true, false}) {
    SurfacePoint point = on_floor;
    point.front = front;
    expect_near(refracted_ray(point, slanting, 1.0F)->direction, slanting, 1e-7);
    expect_near(refracted_ray(point, {0.0F, -1.0F, 0.0F}, 1.7F)->direction, {0.0, -1.0, 0.0}, 1e-7);
  }
}

TEST(RefractedRay, IsTotallyReflectedBeyondTheCriticalAngle) {
  SurfacePoint from_inside = on_floor;
  from_inside.front = false;
  const double critical = std::asin(1.0 / 1.5);
  for (const double angle : {critical - 1e-4, critical + 1e-4}) {
    const glm::vec3 direction(glm::dvec3(std::sin(angle), -std::cos(angle), 0.0));
    EXPECT_EQ(refracted_ray(from_inside, direction, 1.5F).has_value(), angle < critical);
    EXPECT_TRUE(refracted_ray(on_floor, direction, 1.5F));
    EXPECT_EQ(refracted_ray(on_floor, direction, 1.0F / 1.5F).has_value(), angle < critical);
  }
  EXPECT_FALSE(refracted_ray(from_inside, slanting, INFINITY));
}

TEST(BentRays, StayOnTheirSideOfTheTriangleWhateverTheShadingNormal) {
  std::mt19937 random(11);
  std::normal_distribution<double> part;
  int fallbacks = 0;
  for (int i = 0; i < 20000; ++i) {
    const auto unit = [&] { return glm::normalize(glm::dvec3(part(random), part(random), part(random))); };
    SurfacePoint point = on_floor;
    point.shading_normal = unit();
    if (point.shading_normal.y < 0.0) point.shading_normal = -point.shading_normal;
    point.front = i % 2 == 0;
    glm::dvec3 arriving = unit();
    if (arriving.y > 0.0) arriving = -arriving;
    const glm::vec3 direction(arriving);
    const Ray mirrored = mirrored_ray(point, direction);
    EXPECT_GE(mirrored.direction.y, 0.0F);
    EXPECT_NEAR(glm::length(mirrored.direction), 1.0F, 1e-6F);
    const glm::dvec3 about_shading =
        arriving - 2.0 * glm::dot(arriving, point.shading_normal) * point.shading_normal;
    fallbacks += glm::dot(arriving, point.shading_normal) >= 0.0 || about_shading.y <= 0.0 ? 1 : 0;
    const auto refracted = refracted_ray(point, direction, 1.5F);
    if (!refracted) continue;
    EXPECT_LE(refracted->direction.y, 0.0F);
    EXPECT_NEAR(glm::length(refracted->direction), 1.0F, 1e-6F);
  }
  EXPECT_GT(fallbacks, 1000);
}

TEST(BentRays, StartInTheCube) {
  const SurfacePoint at_edge{{0.5, 1.0, -1.0}, {0.0, root_half, -root_half}, {0.0, root_half, -root_half}};
  const Ray ray = mirrored_ray(at_edge, {0.0F, -1.0F, 0.5F});
  EXPECT_EQ(ray.origin, glm::vec3(0.5F, 1.0F, -1.0F));
  EXPECT_TRUE(acceptable(ray));
}

TEST(SurfacePointSide, IsFrontWhereCornersRunCounterclockwise) {
  Mesh mesh;
  mesh.vertices = {{-0.5F, 0.0F, -0.5F}, {-0.5F, 0.0F, 0.5F}, {0.5F, 0.0F, 0.5F}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(surface_point(mesh, 0, {{-0.25F, 0.5F, 0.0F}, {0.0F, -1.0F, 0.0F}}).front);
  EXPECT_FALSE(surface_point(mesh, 0, {{-0.25F, -0.5F, 0.0F}, {0.0F, 1.0F, 0.0F}}).front);
}

TEST(LightSum, IsTheSameInAnyOrder) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> exponent(-40.0F, 34.0F);
  std::vector<glm::vec3> parts;
  for (int i = 0; i < 40; ++i)
    parts.emplace_back(std::exp2(exponent(random)), std::exp2(exponent(random)), 0.1F);
  const auto sum = [&] {
    LightSum light;
    for (const glm::vec3& part : parts) light.add(part);
    return light.value();
  };
  const glm::vec3 expected = sum();
  EXPECT_NEAR(expected.z, 4.0F, 1e-6F);
  for (int i = 0; i < 100; ++i) {
    std::shuffle(parts.begin(), parts.end(), random);
    EXPECT_EQ(sum(), expected);
  }
}

TEST(LightSum, StaysAtTheEndsOfItsRange) {
  LightSum light;
  light.add({INFINITY, -1.0F, NAN});
  EXPECT_EQ(light.value(), glm::vec3(0x1p31F, 0.0F, 0.0F));
  for (int i = 0; i < 3; ++i) light.add({3e38F, 0x1p-32F, 0x1p-33F});
  EXPECT_EQ(light.value(), glm::vec3(0x1p32F, 3 * 0x1p-32F, 0.0F));
}

/// A rectangle of two triangles, with corners counterclockwise as seen from the side of its normal.
void add_rectangle(Scene& scene, const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v,
                   std::uint8_t material) {
  const auto base = static_cast<std::uint32_t>(scene.mesh.vertices.size());
  scene.mesh.vertices.insert(scene.mesh.vertices.end(), {corner, corner + u, corner + u + v, corner + v});
  scene.mesh.triangles.insert(scene.mesh.triangles.end(),
                              {{base, base + 1, base + 2}, {base, base + 2, base + 3}});
  scene.mesh.materials.insert(scene.mesh.materials.end(), 2, material);
}

Material matt_with(float albedo) {
  return {glm::vec3(albedo)};
}
Material mirror_with(float part) {
  return {glm::vec3(0.0F), glm::vec3(part)};
}
Material glass_with(float reflected, float passed, float index) {
  return {glm::vec3(0.0F), glm::vec3(reflected), glm::vec3(passed), index};
}

struct Followed {
  glm::vec3 light;
  std::vector<RayTask> tasks;  ///< in the order in which they ended, the primary one first
  [[nodiscard]] std::size_t count(RayKind kind) const {
    return static_cast<std::size_t>(
        std::count_if(tasks.begin(), tasks.end(), [&](const RayTask& t) { return t.kind == kind; }));
  }
};

/// Follows one ray to its end by testing all triangles; `order` picks the next of the waiting tasks.
template <class Order>
Followed follow(const Scene& scene, const Ray& ray, const WhittedOptions& options, const Order& order) {
  const Whitted whitted(scene, options);
  Followed result;
  LightSum light;
  std::vector<RayTask> waiting(1);
  waiting[0].ray = ray;
  while (!waiting.empty()) {
    std::swap(waiting[order(waiting.size())], waiting.back());
    const RayTask task = waiting.back();
    waiting.pop_back();
    EXPECT_TRUE(acceptable(task.ray));
    Hit hit;
    for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i)
      intersect_triangle(scene.mesh, i, task.ray, hit);
    whitted.end(task, hit.triangle, light, waiting);
    result.tasks.push_back(task);
  }
  result.light = light.value();
  return result;
}
Followed follow(const Scene& scene, const Ray& ray, const WhittedOptions& options = {}) {
  return follow(scene, ray, options, [](std::size_t) { return std::size_t{0}; });
}

/// A slanting ray to the middle of a mirror on the floor, in which a matt wall is seen.
Scene mirror_and_wall() {
  Scene scene;
  scene.materials = {mirror_with(0.5F), matt_with(0.8F)};
  add_rectangle(scene, {-0.25F, 0.0F, 0.25F}, {0.5F, 0.0F, 0.0F}, {0.0F, 0.0F, -0.5F}, 0);
  add_rectangle(scene, {0.5F, 0.0F, -0.5F}, {0.0F, 0.0F, 1.0F}, {0.0F, 0.9F, 0.0F}, 1);
  scene.lights = {{{-0.5F, 0.5F, 0.0F}, glm::vec3(1.0F)}};
  return scene;
}
const Ray to_mirror{{-0.5F, 0.5F, 0.0F}, slanting};

TEST(Whitted, MirrorShowsTheWallAndTheShadowOnIt) {
  Scene scene = mirror_and_wall();
  const Followed lit = follow(scene, to_mirror);
  ASSERT_EQ(lit.tasks.size(), 3U);  // the mirror has no diffuse light, so no shadow ray starts there
  EXPECT_EQ(lit.tasks[1].kind, RayKind::secondary);
  EXPECT_EQ(lit.tasks[1].weight, glm::vec3(0.5F));
  EXPECT_EQ(lit.tasks[1].depth, 1);
  EXPECT_EQ(lit.tasks[2].kind, RayKind::shadow);
  expect_near(lit.tasks[2].ray.origin, {0.5, 0.5, 0.0}, 2e-5);
  // The wall is seen at height 0.5, directly in front of the light.
  SurfacePoint seen = on_floor;
  seen.shading_normal = {-1.0, 0.0, 0.0};
  const float ambient_light = 0.5F * 0.8F * ambient(seen).x;
  EXPECT_NEAR(lit.light.x, 0.5F * 0.8F + ambient_light, 1e-4F);

  add_rectangle(scene, {0.25F, 0.4F, -0.1F}, {0.0F, 0.2F, 0.0F}, {0.0F, 0.0F, 0.2F}, 1);
  const Followed shadowed = follow(scene, to_mirror);
  EXPECT_EQ(shadowed.tasks.size(), 3U);
  EXPECT_NEAR(shadowed.light.x, ambient_light, 1e-4F);
}

TEST(Whitted, LightThatBringsNothingIsNotAskedFor) {
  const auto shadow_rays = [](const Scene& scene) {
    return follow(scene, {{0.0F, 0.4F, 0.0F}, {1.0F, 0.0F, 0.0F}}).count(RayKind::shadow);
  };
  Scene scene = mirror_and_wall();
  EXPECT_EQ(shadow_rays(scene), 1U);
  scene.lights.push_back({{0.75F, 0.5F, 0.0F}, glm::vec3(1.0F)});  // behind the wall
  scene.lights.push_back({{0.0F, 0.75F, 0.0F}, glm::vec3(0.0F)});
  scene.lights.push_back({{0.0F, INFINITY, 0.0F}, glm::vec3(1.0F)});
  EXPECT_EQ(shadow_rays(scene), 1U);
  scene.materials[1] = matt_with(0.0F);
  EXPECT_EQ(shadow_rays(scene), 0U);
  scene.materials[1] = {glm::vec3(0.0F, 0.0F, 0.1F)};
  scene.lights = {{{0.0F, 0.75F, 0.0F}, {1.0F, 1.0F, 0.0F}}};  // yellow light on blue paint
  EXPECT_EQ(shadow_rays(scene), 0U);
}

/// A slab of glass, |y| <= 0.1, wide enough for the rays below.
Scene slab(const Material& material) {
  Scene scene;
  scene.materials = {material};
  add_rectangle(scene, {-0.9F, 0.1F, 0.9F}, {1.8F, 0.0F, 0.0F}, {0.0F, 0.0F, -1.8F}, 0);
  add_rectangle(scene, {-0.9F, -0.1F, -0.9F}, {1.8F, 0.0F, 0.0F}, {0.0F, 0.0F, 1.8F}, 0);
  return scene;
}

TEST(Whitted, GlassSlabMovesARayAsideByTheKnownAmount) {
  const Followed followed = follow(slab(glass_with(0.0F, 0.9F, 1.5F)), {{-0.5F, 0.5F, 0.0F}, slanting});
  ASSERT_EQ(followed.tasks.size(), 3U);
  EXPECT_EQ(followed.tasks[1].source, RayTask::refracted);
  const RayTask& last = followed.tasks[2];
  expect_near(last.ray.direction, slanting, 1e-6);
  EXPECT_NEAR(last.weight.x, 0.9F * 0.9F, 1e-6F);
  EXPECT_EQ(followed.light, last.weight * sky(last.ray.direction));
  // From (-0.1, 0.1) the ray is 0.2 tan(asin(sin 45 degrees / 1.5)) further right at the lower face.
  const double sine = root_half / 1.5;
  const double tangent = sine / std::sqrt(1.0 - sine * sine);
  expect_near(last.ray.origin, {-0.1 + 0.2 * tangent, -0.1, 0.0}, 4e-5);
}

TEST(Whitted, TotalReflectionSendsAllLightTheOtherWay) {
  const Scene scene = slab(glass_with(0.25F, 0.5F, 1.5F));
  const Ray inside{{-0.75F, 0.0F, 0.0F}, slanting};  // 45 degrees are beyond the critical 41.8
  const Followed followed = follow(scene, inside, {.bounces = 3, .cutoff = 0.0F});
  ASSERT_EQ(followed.tasks.size(), 4U);
  for (std::size_t i = 1; i < 4; ++i) {
    EXPECT_EQ(followed.tasks[i].source, RayTask::mirrored);
    EXPECT_EQ(followed.tasks[i].weight, glm::vec3(std::pow(0.75F, static_cast<float>(i))));
    EXPECT_EQ(followed.tasks[i].depth, i);
  }
  EXPECT_EQ(followed.light, glm::vec3(0.0F));
}

TEST(Whitted, GlassSendsBothRaysAndTheirNumberIsLimited) {
  const Scene scene = slab(glass_with(0.5F, 0.5F, 1.1F));
  const Ray above{{-0.5F, 0.5F, 0.0F}, slanting};
  const auto secondary = [&](const WhittedOptions& options) {
    return follow(scene, above, options).count(RayKind::secondary);
  };
  EXPECT_EQ(secondary({.bounces = 0}), 0U);
  EXPECT_EQ(secondary({.bounces = 1}), 2U);
  // The mirrored ray has left. The refracted ray splits at each face, and one half stays inside.
  EXPECT_EQ(secondary({.bounces = 2}), 4U);
  EXPECT_EQ(secondary({.bounces = 5}), 10U);
  EXPECT_EQ(secondary({.bounces = 5, .cutoff = 0.25F}), 4U);  // weights 1/2, 1/4
  EXPECT_EQ(secondary({.bounces = 5, .cutoff = 0.26F}), 2U);
}

TEST(Whitted, MirrorsFacingEachOtherAreFollowedToTheLimit) {
  Scene scene = slab(mirror_with(1.0F));
  const Ray between{{0.0F, 0.0F, 0.0F}, {0.0F, 1.0F, 0.0F}};
  EXPECT_EQ(follow(scene, between, {.bounces = 64}).count(RayKind::secondary), 64U);
  scene.materials[0] = mirror_with(0.5F);
  EXPECT_EQ(follow(scene, between, {.bounces = 64}).count(RayKind::secondary), 8U);  // 2^-8 is the cutoff
  scene.materials[0] = matt_with(1.0F);
  EXPECT_EQ(follow(scene, between, {.bounces = 64}).tasks.size(), 1U);
}

TEST(Whitted, LightDoesNotDependOnTheOrderInWhichRaysEnd) {
  Scene scene = slab({glm::vec3(0.2F, 0.1F, 0.3F), glm::vec3(0.3F), glm::vec3(0.45F, 0.5F, 0.4F), 1.3F});
  add_rectangle(scene, {0.6F, -0.5F, -0.5F}, {0.0F, 0.0F, 1.0F}, {0.0F, 0.9F, 0.0F}, 0);
  scene.lights = {{{-0.5F, 0.8F, 0.3F}, {0.9F, 0.8F, 0.7F}}, {{0.1F, -0.6F, -0.2F}, {0.3F, 0.5F, 0.7F}}};
  const Ray ray{{-0.5F, 0.5F, 0.0F}, slanting};
  const WhittedOptions options{.bounces = 8, .cutoff = 0.0F};
  const Followed first = follow(scene, ray, options);
  EXPECT_GT(first.tasks.size(), 40U);
  std::mt19937 random(2);
  for (int i = 0; i < 20; ++i) {
    const Followed other = follow(scene, ray, options, [&](std::size_t n) { return random() % n; });
    EXPECT_EQ(other.tasks.size(), first.tasks.size());
    EXPECT_EQ(other.light, first.light);
  }
}

TEST(Whitted, OptionsOutOfRangeRejected) {
  const Scene scene;
  const auto error = [&](const WhittedOptions& options) {
    return message_of<std::exception>([&] { (void)Whitted(scene, options); });
  };
  EXPECT_EQ(error({.bounces = -1}), "-1 bounces; allowed are 0 to 64");
  EXPECT_EQ(error({.bounces = 65}), "65 bounces; allowed are 0 to 64");
  EXPECT_EQ(error({.diffuse = -1}), "-1 scattered rays from a surface; allowed are 0 to 256");
  EXPECT_EQ(error({.occlusion = 257}), "257 occlusion rays from a surface; allowed are 0 to 256");
  EXPECT_EQ(error({.cutoff = -0.5F}), "cutoff -0.5; allowed is 0 or more");
  EXPECT_EQ(error({.cutoff = NAN}), "cutoff nan; allowed is 0 or more");
  Scene bright;
  bright.lights.resize(65537);
  EXPECT_EQ(message_of<std::exception>([&] { (void)Whitted(bright, {}); }),
            "65537 lights; at most 65536 are allowed");
}

}  // namespace
}  // namespace hitpipe::ref::whitted_test
