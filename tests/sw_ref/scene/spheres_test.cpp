#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sw_ref/scene/built_in_scenes.hpp"
#include "sw_ref/scene/load_scene.hpp"

namespace hitpipe::ref::spheres_test {
namespace {

TEST(Spheres, HasTheTrianglesAndLightsOfTheThesis) {
  const Scene scene = load_scene("spheres");
  EXPECT_EQ(scene.mesh.triangles.size(), 24'578U);
  EXPECT_EQ(scene.mesh.dropped.size(), 0U);
  EXPECT_EQ(scene.lights.size(), 2U);
  for (int ball = 1; ball <= 12; ++ball)
    EXPECT_EQ(std::count(scene.mesh.materials.begin(), scene.mesh.materials.end(), ball), 2'048) << ball;
  EXPECT_EQ(std::count(scene.mesh.materials.begin(), scene.mesh.materials.end(), 0), 2);
  EXPECT_EQ(scene.materials.size(), 13U);
}

TEST(Spheres, SomeMirrorSomeAreOfGlassMostAreSolid) {
  const std::vector<Material> materials = spheres().materials;
  const auto count = [&](auto&& is) { return std::count_if(materials.begin() + 1, materials.end(), is); };
  EXPECT_EQ(count([](const Material& m) { return m.reflect != glm::vec3(0.0F); }), 3);
  EXPECT_EQ(
      count([](const Material& m) { return m.transmit != glm::vec3(0.0F) && m.refractive_index == 1.5F; }),
      3);
  EXPECT_EQ(materials[0].reflect + materials[0].transmit, glm::vec3(0.0F));
}

TEST(Spheres, BallsRestOnTheFloorAndDoNotCross) {
  const BuiltInDescription scene = spheres();
  struct Ball {
    glm::dvec3 low{1e9}, high{-1e9};
  };
  std::vector<Ball> balls(13);
  for (std::size_t i = 0; i < scene.mesh.triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 p(scene.mesh.vertices[scene.mesh.triangles[i][k]]);
      Ball& ball = balls[scene.mesh.materials[i]];
      ball.low = glm::min(ball.low, p);
      ball.high = glm::max(ball.high, p);
    }
  }
  int on_floor = 0;
  for (std::size_t i = 1; i < balls.size(); ++i) {
    EXPECT_GE(balls[i].low.y, -1e-6) << i;
    on_floor += balls[i].low.y < 1e-6 ? 1 : 0;
    for (std::size_t j = 1; j < i; ++j) {
      const double between = glm::distance(balls[i].low + balls[i].high, balls[j].low + balls[j].high) / 2;
      const double radii = (balls[i].high.x - balls[i].low.x + balls[j].high.x - balls[j].low.x) / 2;
      EXPECT_GE(between, radii - 1e-6) << i << " and " << j;
    }
  }
  EXPECT_EQ(on_floor, 9);
}

TEST(Spheres, NormalsPointOutwardAsTrianglesDo) {
  const Scene scene = load_scene("spheres");
  ASSERT_EQ(scene.mesh.normals.size(), scene.mesh.vertices.size());
  for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i) {
    const Mesh::Corners corners = scene.mesh.corners(i);
    const glm::vec3 normal = glm::cross(corners.b - corners.a, corners.c - corners.a);
    ASSERT_GT(glm::dot(normal, scene.mesh.normals[scene.mesh.triangles[i].x]), 0.0F) << i;
  }
}

TEST(Spheres, IsTheSameEveryTime) {
  const Scene a = load_scene("spheres");
  const Scene b = load_scene("spheres");
  ASSERT_EQ(a.mesh.vertices.size(), b.mesh.vertices.size());
  EXPECT_EQ(
      std::memcmp(a.mesh.vertices.data(), b.mesh.vertices.data(), a.mesh.vertices.size() * sizeof(glm::vec3)),
      0);
  EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
  EXPECT_EQ(a.camera.eye, b.camera.eye);
}

}  // namespace
}  // namespace hitpipe::ref::spheres_test
