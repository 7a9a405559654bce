// The triangle test on whole meshes: no gaps between neighbours, and one closest hit in any order of the
// tests.
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

#include "sw_ref/judge/triangle_test.hpp"
#include "tests/sw_ref/judge/triangle_cases.hpp"

namespace hitpipe::ref::triangle_mesh_test {
namespace {

using cases::Random;
using cases::Rational;

constexpr std::uint64_t seed = 20056;

/// A fan of triangles around one vertex, with random winding. Every pair of neighbours shares an edge. The
/// fan is so flat that no edge is a silhouette for the rays below.
Mesh fan(Random& random, bool coarse) {
  Mesh mesh;
  constexpr std::uint32_t rim = 6;
  mesh.vertices.emplace_back(0.0F, 0.0F, random.coarse() * 0.0625F);
  constexpr std::array<glm::vec2, rim> corner{
      {{0.75F, 0}, {0.5F, 0.5F}, {-0.25F, 0.5F}, {-0.75F, 0}, {-0.5F, -0.5F}, {0.25F, -0.75F}}};
  for (const glm::vec2& at : corner) {
    glm::vec3 vertex(at, random.coarse() * 0.0625F);
    if (!coarse) vertex += 0.05F * cases::fine_point(random);
    mesh.vertices.push_back(vertex);
  }
  for (std::uint32_t i = 0; i < rim; ++i) {
    glm::uvec3 triangle(0, 1 + i, 1 + (i + 1) % rim);
    if (random.coin()) std::swap(triangle.x, triangle.z);
    mesh.triangles.push_back(triangle);
  }
  return mesh;
}

TEST(TriangleMesh, SharedEdgeIsWatertight) {
  std::printf("seed %llu\n", static_cast<unsigned long long>(seed));
  Random random(seed + 1);
  int run = 0;
  for (int i = 0; i < 30'000; ++i) {
    const bool coarse = random.coin();
    const Mesh mesh = fan(random, coarse);
    const glm::vec3 hub = mesh.vertices[0];
    const glm::vec3 spoke = mesh.vertices[1 + random.below(6)] - hub;
    // Quarter steps are exact on the coarse fan; on the other the aim is rounded to either side of the edge.
    const glm::vec3 target = hub + spoke * (static_cast<float>(random.between(0, 3)) * 0.25F);
    Ray ray;
    ray.origin = {random.coarse() * 0.125F, random.coarse() * 0.125F, random.sign()};
    ray.direction = target - ray.origin;
    Hit hit;
    for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
      intersect_triangle(mesh, triangle, ray, hit);
    }
    ASSERT_TRUE(hit.found()) << cases::describe(ray);
    ++run;
  }
  EXPECT_EQ(run, 30'000);
}

/// A closed surface that every ray from the centre must hit: an octahedron split `levels` times, its vertices
/// moved outward or inward along their radius at random.
Mesh star(Random& random, int levels) {
  Mesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (std::uint32_t i = 0; i < 8; ++i) {
    mesh.triangles.emplace_back(i & 1U, 2 + (i >> 1U & 1U), 4 + (i >> 2U & 1U));
  }
  for (int level = 0; level < levels; ++level) {
    std::vector<glm::uvec3> finer;
    std::vector<std::array<std::uint32_t, 3>> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      for (const auto& m : middles) {
        if (m[0] == std::min(i, j) && m[1] == std::max(i, j)) return m[2];
      }
      mesh.vertices.push_back(glm::normalize(mesh.vertices[i] + mesh.vertices[j]));
      middles.push_back(
          {std::min(i, j), std::max(i, j), static_cast<std::uint32_t>(mesh.vertices.size() - 1)});
      return middles.back()[2];
    };
    for (const glm::uvec3& t : mesh.triangles) {
      const std::uint32_t xy = middle(t.x, t.y);
      const std::uint32_t yz = middle(t.y, t.z);
      const std::uint32_t zx = middle(t.z, t.x);
      finer.insert(finer.end(), {{t.x, xy, zx}, {xy, t.y, yz}, {zx, yz, t.z}, {xy, yz, zx}});
    }
    mesh.triangles = std::move(finer);
  }
  for (glm::vec3& v : mesh.vertices) v *= 0.5F + 0.25F * random.signed_unit();
  return mesh;
}

/// The closest hit by definition: smallest exact t, then lowest index.
std::uint32_t closest_by_rationals(const Mesh& mesh, const Ray& ray) {
  std::uint32_t best = Hit::none;
  Rational best_t;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const std::optional<Rational> t = cases::time_of_hit(mesh.corners(i), ray);
    if (t && (best == Hit::none || *t < best_t)) {
      best = i;
      best_t = *t;
    }
  }
  return best;
}

Hit closest(const Mesh& mesh, const Ray& ray, const std::vector<std::uint32_t>& order) {
  Hit hit;
  for (const std::uint32_t triangle : order) intersect_triangle(mesh, triangle, ray, hit);
  return hit;
}

TEST(TriangleMesh, NoRayEscapesAClosedSurface) {
  Random random(seed + 2);
  int run = 0;
  for (int surface = 0; surface < 12; ++surface) {
    const Mesh mesh = star(random, 2);
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    for (int i = 0; i < 3'000; ++i) {
      Ray ray;
      const glm::vec3 vertex = mesh.vertices[random.below(mesh.vertices.size())];
      switch (random.below(4)) {
        case 0:
          ray.direction = vertex;
          break;
        case 1:
          ray.direction = cases::nonzero(vertex + mesh.vertices[random.below(mesh.vertices.size())]);
          break;
        case 2:
          ray.direction = vertex + 0x1p-24F * cases::fine_point(random);
          break;
        default:
          ray.direction = cases::nonzero(cases::fine_point(random));
      }
      ASSERT_TRUE(closest(mesh, ray, order).found()) << cases::describe(ray);
      ++run;
    }
  }
  EXPECT_EQ(run, 36'000);
}

TEST(TriangleMesh, ClosestHitIsTheRationalOne) {
  Random random(seed + 3);
  int ties = 0;
  for (int i = 0; i < 600; ++i) {
    Mesh mesh = fan(random, true);
    mesh.triangles.push_back(mesh.triangles.front());  // a copy, so every hit of it is a tie
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    Ray ray;
    ray.origin = {random.coarse() * 0.125F, random.coarse() * 0.125F, 1};
    ray.direction = mesh.vertices[random.below(mesh.vertices.size())] * 0.5F - ray.origin;
    const Hit hit = closest(mesh, ray, order);
    ASSERT_EQ(hit.triangle, closest_by_rationals(mesh, ray)) << cases::describe(ray);
    Hit last;
    const bool tied = intersect_triangle(mesh, 6, ray, last) && hit.triangle == 0;
    ties += tied ? 1 : 0;
  }
  EXPECT_GT(ties, 50);
}

TEST(TriangleMesh, OrderOfTestsDoesNotMatter) {
  Random random(seed + 4);
  std::mt19937 shuffler(7);
  int run = 0;
  for (int surface = 0; surface < 40; ++surface) {
    Mesh mesh = star(random, 1);
    // Copies of every triangle, some rotated: exact ties that the filter cannot decide.
    const std::vector<glm::uvec3> once = mesh.triangles;
    for (const glm::uvec3& t : once) mesh.triangles.emplace_back(t.y, t.z, t.x);
    std::vector<std::uint32_t> order(mesh.triangles.size());
    std::iota(order.begin(), order.end(), 0U);
    for (int i = 0; i < 60; ++i) {
      Ray ray;
      ray.origin = 0.9F * cases::fine_point(random);
      ray.direction = cases::nonzero(mesh.vertices[random.below(mesh.vertices.size())] - ray.origin);
      ray.length = random.coin() ? Ray::infinite : 1.0F;
      std::sort(order.begin(), order.end());
      const Hit expected = closest(mesh, ray, order);
      for (int repeat = 0; repeat < 4; ++repeat) {
        std::shuffle(order.begin(), order.end(), shuffler);
        const Hit hit = closest(mesh, ray, order);
        ASSERT_EQ(hit.triangle, expected.triangle) << cases::describe(ray);
        ASSERT_EQ(hit.t_low, expected.t_low) << cases::describe(ray);
        ASSERT_EQ(hit.t_high, expected.t_high) << cases::describe(ray);
        ++run;
      }
    }
  }
  EXPECT_EQ(run, 9'600);
}

}  // namespace
}  // namespace hitpipe::ref::triangle_mesh_test
