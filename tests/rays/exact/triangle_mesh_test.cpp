// The triangle test on closed meshes: no ray escapes, and one hit is the closest in any order of the tests.
#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <random>
#include <utility>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "rays/exact/exact_triangle.hpp"
#include "tests/rays/exact/triangle_cases.hpp"

namespace hitpipe::ref::triangle_mesh_test {
namespace {

using cases::Random;
using cases::Rational;

constexpr std::uint64_t seed = 20056;

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
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    const auto middle = [&](std::uint32_t i, std::uint32_t j) {
      const auto [at, is_new] = middles.try_emplace(std::minmax(i, j), mesh.vertices.size());
      if (is_new) mesh.vertices.push_back(glm::normalize(mesh.vertices[i] + mesh.vertices[j]));
      return at->second;
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

Hit closest(const Mesh& mesh, const Ray& ray, const std::vector<std::uint32_t>& order) {
  Hit hit;
  for (const std::uint32_t triangle : order) intersect_triangle(mesh, triangle, ray, hit);
  return hit;
}

std::vector<std::uint32_t> order_of(const Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0U);
  return order;
}

TEST(TriangleMesh, NoRayEscapesAClosedSurface) {
  Random random(seed + 2);
  for (int surface = 0; surface < 12; ++surface) {
    const Mesh mesh = star(random, 2);
    const std::vector<std::uint32_t> order = order_of(mesh);
    const auto vertex = [&] { return mesh.vertices[random.below(mesh.vertices.size())]; };
    for (int i = 0; i < 3'000; ++i) {
      const glm::vec3 on_edge = 0.5F * (vertex() + vertex());
      const std::array directions{vertex(), on_edge, vertex() + 0x1p-24F * cases::fine_point(random),
                                  cases::fine_point(random)};
      const Ray ray{{}, cases::nonzero(directions[random.below(4)]), Ray::infinite};
      ASSERT_TRUE(closest(mesh, ray, order).found()) << adversary::to_text(ray);
    }
  }
}

/// The closest hit has the smallest exact t, and the lowest index among ties.
TEST(TriangleMesh, ClosestHitIsTheRationalOneInAnyOrderOfTests) {
  Random random(seed + 4);
  std::mt19937 shuffler(7);
  int ties = 0;
  for (int surface = 0; surface < 20; ++surface) {
    Mesh mesh = star(random, 1);
    // Copies of every triangle, some rotated: exact ties that the filter cannot decide.
    const std::vector<glm::uvec3> once = mesh.triangles;
    for (const glm::uvec3& t : once) mesh.triangles.emplace_back(t.y, t.z, t.x);
    std::vector<std::uint32_t> order = order_of(mesh);
    for (int i = 0; i < 60; ++i) {
      Ray ray;
      ray.origin = 0.9F * cases::fine_point(random);
      ray.direction = cases::nonzero(mesh.vertices[random.below(mesh.vertices.size())] - ray.origin);
      ray.length = random.coin() ? Ray::infinite : 1.0F;
      std::optional<std::pair<Rational, std::uint32_t>> best;
      for (std::uint32_t triangle = 0; triangle < mesh.triangles.size(); ++triangle) {
        const std::optional<Rational> t = cases::time_of_hit(mesh.corners(triangle), ray);
        if (!t) continue;
        if (best && *t == best->first) ++ties;
        if (!best || *t < best->first) best = {*t, triangle};
      }
      const Hit expected = closest(mesh, ray, order);
      for (int repeat = 0; repeat < 4; ++repeat) {
        std::shuffle(order.begin(), order.end(), shuffler);
        const Hit hit = closest(mesh, ray, order);
        ASSERT_EQ(hit.triangle, best ? best->second : Hit::none) << adversary::to_text(ray);
        ASSERT_EQ(hit.t_low, expected.t_low) << adversary::to_text(ray);
        ASSERT_EQ(hit.t_high, expected.t_high) << adversary::to_text(ray);
      }
    }
  }
  EXPECT_GT(ties, 500);
}

}  // namespace
}  // namespace hitpipe::ref::triangle_mesh_test
