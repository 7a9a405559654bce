// Primary rays, surface points and shadow rays.
#include "sw_ref/render/shade.hpp"

#include <cmath>
#include <random>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/camera.hpp"

namespace hitpipe::ref::shade_test {
namespace {

Mesh floor_triangle(float height = 0.0F) {
  Mesh mesh;
  mesh.vertices = {{-0.9F, height, -0.9F}, {-0.9F, height, 0.9F}, {0.9F, height, 0.9F}};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

const Ray down{{-0.5F, 0.8F, 0.25F}, {0.0F, -1.0F, 0.0F}};

TEST(PrimaryRay, CornerPixelsSpanTheFieldOfView) {
  Camera camera;
  camera.tan_half_height = 0.5;
  const int width = 400, height = 200;
  const Ray centre = primary_ray(camera, 200, 100, width, height);
  EXPECT_NEAR(centre.direction.x, 0.0025F, 1e-4F);
  EXPECT_NEAR(centre.direction.y, -0.0025F, 1e-4F);
  const Ray corner = primary_ray(camera, 0, 0, width, height);
  EXPECT_NEAR(corner.direction.x / corner.direction.z, 1.0F * 399 / 400, 1e-6F);
  EXPECT_NEAR(corner.direction.y / -corner.direction.z, 0.5F * 199 / 200, 1e-6F);
  EXPECT_TRUE(corner.is_infinite());
  EXPECT_NEAR(glm::length(corner.direction), 1.0F, 1e-6F);
  EXPECT_EQ(corner.origin, camera.eye);
}

/// Looks down on the cube from just inside its top; the image is 1 high.
Camera plan() {
  Camera camera;
  camera.eye = {0.25F, 0.75F, -0.125F};
  camera.forward = {0.0, -1.0, 0.0};
  camera.right = {1.0, 0.0, 0.0};
  camera.up = {0.0, 0.0, -1.0};
  camera.projection = Projection::orthographic;
  camera.half_height = 0.5;
  return camera;
}

TEST(ParallelRay, AllPixelsHaveOneDirectionAndTheirOwnPlaceInThePlane) {
  const Camera camera = plan();
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 8; ++x) {
      const Ray ray = primary_ray(camera, x, y, 8, 16);
      EXPECT_EQ(ray.direction, glm::vec3(0.0F, -1.0F, 0.0F));
      EXPECT_TRUE(ray.is_infinite());
      // A pixel is 1/16 wide and high; the first lies half a pixel inside the corner at the upper left.
      EXPECT_EQ(ray.origin, glm::vec3(0.25F - 0.25F + (static_cast<float>(x) + 0.5F) / 16.0F, 0.75F,
                                      -0.125F - 0.5F + (static_cast<float>(y) + 0.5F) / 16.0F));
    }
  }
}

TEST(ParallelRay, DirectionIsTheRoundedOneAlongASlantToo) {
  Camera camera = plan();
  camera.forward = glm::normalize(glm::dvec3(-1.0, -2.0, 0.5));
  camera.right = glm::normalize(glm::cross(camera.forward, glm::dvec3(0.0, 1.0, 0.0)));
  camera.up = glm::cross(camera.right, camera.forward);
  for (int x = 0; x < 8; ++x) {
    const Ray ray = primary_ray(camera, x, 3, 8, 8);
    EXPECT_EQ(ray.direction, glm::vec3(camera.forward));
    const glm::dvec3 aside = glm::dvec3(ray.origin) - glm::dvec3(camera.eye);
    EXPECT_NEAR(glm::dot(aside, camera.forward), 0.0, 1e-7);
    EXPECT_NEAR(glm::dot(aside, camera.right), (x - 3.5) / 8.0, 1e-7);
    EXPECT_NEAR(glm::dot(aside, camera.up), 0.5 / 8.0, 1e-7);
  }
}

glm::dvec3 on_plane(const Camera& camera, double across, double upward) {
  return glm::dvec3(camera.eye) + across * camera.right + upward * camera.up;
}

TEST(ParallelRay, FromOutsideTheCubeStartsWhereItEnters) {
  Camera camera = plan();
  camera.forward = glm::normalize(glm::dvec3(-1.0, -1.0, 0.0));
  camera.right = {0.0, 0.0, -1.0};
  camera.up = glm::normalize(glm::dvec3(-1.0, 1.0, 0.0));
  // 0.5 up from (0.25, 0.75) is (-0.10, 1.10), above the cube's top.
  const double upward = 0.5;
  const glm::dvec3 start = on_plane(camera, 0.0, upward);
  ASSERT_GT(start.y, 1.1);
  const Ray ray = parallel_ray(start, camera);
  EXPECT_EQ(ray.origin.y, 1.0F);
  EXPECT_NEAR(ray.origin.x, start.x - (start.y - 1.0), 1e-6);
  EXPECT_EQ(ray.origin.z, camera.eye.z);
  EXPECT_EQ(ray.direction, glm::vec3(camera.forward));
}

TEST(ParallelRay, ThatNeverEntersTheCubeLeavesItAtOnce) {
  Camera camera = plan();
  EXPECT_EQ(parallel_ray(on_plane(camera, 0.76, 0.0), camera).origin, glm::vec3(1.0F, -1.0F, 1.0F));
  EXPECT_EQ(parallel_ray(on_plane(camera, 1e6, -1e6), camera).origin, glm::vec3(1.0F, -1.0F, 1.0F));
  camera.forward = glm::normalize(glm::dvec3(1.0, -1.0, -0.5));
  EXPECT_EQ(parallel_ray(on_plane(camera, 3.0, 0.0), camera).origin, glm::vec3(1.0F, -1.0F, -1.0F));
  // It enters on the left of that.
  EXPECT_NE(parallel_ray(on_plane(camera, 0.5, 0.0), camera).origin, glm::vec3(1.0F, -1.0F, -1.0F));
}

TEST(ParallelRay, FirstThatBeginsOutsideTheCubeIsFound) {
  Camera camera = plan();  // it looks down from (0.25, 0.75, -0.125); its rows go along x
  camera.half_height = 0.5;
  EXPECT_EQ(first_ray_outside(camera, 100, 100), std::nullopt);
  // 1.25 of the pixels' 2 lie to the left of x = 1: columns 0 to 124.
  EXPECT_EQ(first_ray_outside(camera, 200, 100), 175U);
  camera.projection = Projection::perspective;
  EXPECT_EQ(first_ray_outside(camera, 200, 100), std::nullopt);
}

TEST(Depth, IsFromTheEyeOrFromThePlane) {
  Camera camera = plan();
  const glm::dvec3 position(0.25 + 0.3, 0.75 - 0.4, -0.125);
  EXPECT_NEAR(depth_of(camera, position), 0.4, 1e-15);
  camera.projection = Projection::perspective;
  EXPECT_NEAR(depth_of(camera, position), 0.5, 1e-15);
}

TEST(SurfacePoint, LiesWhereTheRayMeetsTheTriangle) {
  const SurfacePoint point = surface_point(floor_triangle(), 0, down);
  EXPECT_LT(glm::distance(point.position, glm::dvec3(-0.5, 0.0, 0.25)), 1e-15);
}

TEST(SurfacePoint, NormalsFaceTheRayFromEitherSide) {
  Mesh mesh = floor_triangle();
  mesh.normals.assign(3, glm::normalize(glm::vec3(0.1F, 1.0F, 0.0F)));
  const SurfacePoint above = surface_point(mesh, 0, down);
  EXPECT_EQ(above.normal, glm::dvec3(0.0, 1.0, 0.0));
  EXPECT_GT(above.shading_normal.y, 0.9);
  const SurfacePoint below = surface_point(mesh, 0, {{-0.5F, -0.8F, 0.25F}, {0.0F, 1.0F, 0.0F}});
  EXPECT_EQ(below.normal, glm::dvec3(0.0, -1.0, 0.0));
  EXPECT_LT(below.shading_normal.y, -0.9);
}

TEST(SurfacePoint, StaysOnTheTriangleWhenTheRayGrazesIt) {
  const Mesh mesh = floor_triangle();
  for (const float slope : {1e-3F, 1e-12F, 1e-30F, 1e-45F}) {
    const SurfacePoint point = surface_point(mesh, 0, {{-0.9F, slope, 0.0F}, {1.0F, -slope, 0.0F}});
    EXPECT_EQ(point.position.y, 0.0) << slope;
    EXPECT_LE(std::abs(point.position.x), 0.9F) << slope;
    EXPECT_LE(std::abs(point.position.z), 0.9F) << slope;
    EXPECT_EQ(point.normal, glm::dvec3(0.0, 1.0, 0.0)) << slope;
  }
}

TEST(SurfacePoint, RoughCoordinatesAreCutToTheTriangle) {
  // Rays that miss it represent rays whose barycentric coordinates are mostly rounding errors.
  for (const glm::vec3& past : {glm::vec3(0.8F, 0.5F, -0.8F), {-0.99F, 0.5F, 0.0F}, {0.0F, 0.5F, 0.99F}}) {
    const SurfacePoint point = surface_point(floor_triangle(), 0, {past, {0.0F, -1.0F, 0.0F}});
    EXPECT_GE(point.position.x, -0.9F);
    EXPECT_LE(point.position.z, 0.9F + 1e-7F);
    EXPECT_GE(point.position.z, point.position.x - 1e-7);
  }
}

TEST(SurfacePoint, SliverWithoutNormalInDoubleStillHasOne) {
  Mesh mesh;
  mesh.vertices = {{0.5F, 0.5F, 0.0F}, {0.75F, 0.75F, 0.0F}, {0x1p-149F, 0.0F, 0.0F}};
  mesh.triangles = {{0, 1, 2}};
  ASSERT_TRUE(has_area(mesh.corners(0)));
  const SurfacePoint point = surface_point(mesh, 0, {{0.6F, 0.6F, 0.9F}, {0.0F, 0.0F, -2.0F}});
  EXPECT_EQ(point.normal, glm::dvec3(0.0, 0.0, 1.0));
  EXPECT_EQ(point.position, glm::dvec3(0.5, 0.5, 0.0));
}

TEST(ShadowRay, EndsAtTheLightAndStartsOnItsSide) {
  const Light light{{0.25F, 0.75F, -0.5F}, {1, 1, 1}};
  const auto ray = shadow_ray(surface_point(floor_triangle(), 0, down), light);
  ASSERT_TRUE(ray);
  EXPECT_EQ(ray->length, 1.0F);
  EXPECT_EQ(ray->origin, glm::vec3(-0.5F, 0x1p-17F, 0.25F));
  EXPECT_EQ(ray->direction, light.position - ray->origin);
}

TEST(ShadowRay, NoneGoesToALightBehindTheSurface) {
  const SurfacePoint point = surface_point(floor_triangle(), 0, down);
  EXPECT_FALSE(shadow_ray(point, {{0.0F, -0.5F, 0.0F}, {1, 1, 1}}));
  EXPECT_FALSE(shadow_ray(point, {{0.3F, 0.0F, 0.0F}, {1, 1, 1}}));
}

TEST(ShadowRay, ToASunHasItsDirectionAndNoEnd) {
  const Light sun{glm::normalize(glm::vec3(0.3F, 0.5F, -0.2F)), {1, 1, 1}, LightKind::sun};
  const auto ray = shadow_ray(surface_point(floor_triangle(), 0, down), sun);
  ASSERT_TRUE(ray);
  EXPECT_TRUE(ray->is_infinite());
  EXPECT_EQ(ray->origin, glm::vec3(-0.5F, 0x1p-17F, 0.25F));
  EXPECT_EQ(ray->direction, sun.position);
}

TEST(ShadowRay, NoneGoesToASunBehindTheSurfaceOrAlongIt) {
  // High above the origin: a point light at these places would be behind it.
  const SurfacePoint point = surface_point(floor_triangle(0.75F), 0, down);
  EXPECT_TRUE(shadow_ray(point, {{0.0F, 0.5F, 0.0F}, {1, 1, 1}, LightKind::sun}));
  EXPECT_FALSE(shadow_ray(point, {{0.0F, 0.5F, 0.0F}, {1, 1, 1}}));
  EXPECT_FALSE(shadow_ray(point, {{0.0F, -1.0F, 0.0F}, {1, 1, 1}, LightKind::sun}));
  EXPECT_FALSE(shadow_ray(point, {{1.0F, 0.0F, 0.0F}, {1, 1, 1}, LightKind::sun}));
}

TEST(ShadowRay, OriginIsMovedOntoTheCube) {
  const SurfacePoint point{{0.5, 1.0, -0.25}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  const auto ray = shadow_ray(point, {{0.0F, 2.0F, 0.0F}, {1, 1, 1}});
  ASSERT_TRUE(ray);
  EXPECT_EQ(ray->origin, glm::vec3(0.5F, 1.0F, -0.25F));
}

TEST(ShadowRay, OffsetExceedsTheRoundingOfTheOrigin) {
  std::mt19937 random(3);
  std::uniform_real_distribution<float> value(-0.99F, 0.99F);
  int tested = 0;
  for (int i = 0; i < 2000; ++i) {
    Mesh mesh;
    for (int k = 0; k < 3; ++k) mesh.vertices.emplace_back(value(random), value(random), value(random));
    mesh.triangles = {{0, 1, 2}};
    const glm::vec3 origin(value(random), value(random), value(random));
    const glm::vec3 middle = (mesh.vertices[0] + mesh.vertices[1] + mesh.vertices[2]) / 3.0F;
    const SurfacePoint point = surface_point(mesh, 0, {origin, middle - origin});
    const auto ray = shadow_ray(point, {origin, {1, 1, 1}});
    if (!ray) continue;
    ++tested;
    const double height = glm::dot(glm::dvec3(ray->origin) - glm::dvec3(mesh.vertices[0]), point.normal);
    EXPECT_NEAR(height, shadow_offset, shadow_offset / 16);
  }
  EXPECT_GT(tested, 1900);
}

TEST(Direct, FollowsLambertsLaw) {
  const SurfacePoint point{{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}};
  const auto sixty_degrees = direct(point, {{std::sqrt(3.0F) / 2, 0.5F, 0.0F}, {2.0F, 1.0F, 0.5F}});
  EXPECT_NEAR(sixty_degrees.x, 1.0F, 1e-6F);
  EXPECT_NEAR(sixty_degrees.y, 0.5F, 1e-6F);
  EXPECT_NEAR(sixty_degrees.z, 0.25F, 1e-6F);
  EXPECT_EQ(direct(point, {{0.5F, -0.5F, 0.0F}, {1, 1, 1}}), glm::vec3(0.0F));
}

TEST(Direct, OfASunIsTheSameEverywhere) {
  const Light sun{{0.6F, 0.8F, 0.0F}, {2.0F, 1.0F, 0.5F}, LightKind::sun};
  for (const glm::dvec3& at : {glm::dvec3(0.0), {0.6, 0.8, 0.0}, {-0.9, 0.9, 0.3}}) {
    const glm::vec3 light = direct({at, {0.0, 1.0, 0.0}, {0.0, 1.0, 0.0}}, sun);
    EXPECT_NEAR(light.x, 1.6F, 1e-6F);
    EXPECT_NEAR(light.z, 0.4F, 1e-6F);
  }
  EXPECT_EQ(direct({{0.0, 0.0, 0.0}, {0.0, -1.0, 0.0}, {0.0, -1.0, 0.0}}, sun), glm::vec3(0.0F));
}

}  // namespace
}  // namespace hitpipe::ref::shade_test
