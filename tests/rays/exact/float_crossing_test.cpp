// Closed meshes of binary32 corners: every line crosses them an even number of times, whatever it meets. The integer
// world's rule gives the same answers where both worlds have the same numbers.
#include "rays/exact/float_crossing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "rays/world/crossing.hpp"
#include "tests/rays/exact/triangle_cases.hpp"

namespace hitpipe::ref::float_crossing_test {
namespace {

using Triangles = std::vector<Mesh::Corners>;

/// A closed surface: the convex or folded octahedron over these points, two poles and four around.
Triangles octahedron(const std::array<glm::vec3, 6>& p) {
  Triangles all;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t next = (i + 1) % 4;
    all.push_back({p[4], p[i], p[next]});
    all.push_back({p[5], p[next], p[i]});
  }
  return all;
}

struct Total {
  int crossings = 0;
  int sides = 0;
  int ties = 0;
};

Total total(const Triangles& mesh, const Ray& ray) {
  Total sum;
  for (const Mesh::Corners& corners : mesh) {
    const auto crossing = float_crossing(corners, ray);
    if (!crossing) continue;
    sum.ties += crossing->tie ? 1 : 0;
    if (!crossing->once) continue;
    ++sum.crossings;
    sum.sides += crossing->side;
  }
  return sum;
}

/// Numbers of a coarse lattice, so that lines meet edges and corners, or of all sizes.
float number(std::mt19937& random, int kind) {
  if (kind == 0) return static_cast<float>(static_cast<int>(random() % 9) - 4) * 0.25F;
  const float x = static_cast<float>(random() >> 8U) * 0x1p-23F - 1.0F;
  return kind == 1 ? x : std::ldexp(x, -static_cast<int>(random() % 120));
}

glm::vec3 point(std::mt19937& random, int kind) {
  glm::vec3 p;
  for (int axis = 0; axis < 3; ++axis) p[axis] = number(random, kind);
  return p;
}

TEST(FloatCrossing, LinesCrossClosedMeshesAnEvenNumberOfTimes) {
  std::mt19937 random(62);
  int ties = 0;
  int crossed = 0;
  for (int i = 0; i < 60'000; ++i) {
    const int kind = i % 3;
    std::array<glm::vec3, 6> points;
    for (glm::vec3& p : points) p = point(random, kind);
    const Triangles mesh = octahedron(points);
    Ray ray;
    // From far outside towards a corner, a point of an edge, or anything.
    const glm::vec3 aim = random() % 2 != 0   ? points[random() % 6]
                          : random() % 2 != 0 ? (points[random() % 4] + points[4]) * 0.5F
                                              : point(random, kind);
    ray.direction = kind == 0 ? point(random, 0) : point(random, kind);
    if (ray.direction == glm::vec3(0)) continue;
    const float back = kind == 0 ? 16.0F
                                 : 4.0F / std::max({std::fabs(ray.direction.x), std::fabs(ray.direction.y),
                                                    std::fabs(ray.direction.z)});
    ray.origin = aim - ray.direction * back;
    ray.length = std::numeric_limits<float>::infinity();
    const Total sum = total(mesh, ray);
    ASSERT_EQ(sum.crossings % 2, 0) << i;
    ASSERT_EQ(sum.sides, 0) << i;
    ties += sum.ties;
    crossed += sum.crossings;
  }
  EXPECT_GT(ties, 10'000);
  EXPECT_GT(crossed, 10'000);
}

/// The same small numbers in both worlds: corners are whole, and origins and directions are multiples of 1/2 and 1/4.
TEST(FloatCrossing, IsTheIntegerWorldsRule) {
  const hls::WorldBits bits{.coord = 8, .finer = 1, .slope = 8};
  ASSERT_TRUE(bits.proved());
  std::mt19937 random(63);
  int ties = 0;
  int not_once = 0;
  for (int i = 0; i < 200'000; ++i) {
    IntTriangle triangle;
    std::array<glm::vec3, 3> corners{};
    for (std::size_t corner = 0; corner < 3; ++corner)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const auto at = static_cast<std::int32_t>(random() % 9) - 4;
        triangle.corners[corner][axis] = at;
        corners[corner][static_cast<int>(axis)] = static_cast<float>(at);
      }
    IntRay in_integers;
    in_integers.length = (std::int64_t{1} << bits.coord) - 1;
    Ray in_floats;
    in_floats.length = std::numeric_limits<float>::infinity();
    const std::size_t full = random() % 3;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int at = static_cast<int>(random() % 17) - 8;
      const int way = axis == full ? (random() % 2 != 0 ? 4 : -4) : static_cast<int>(random() % 9) - 4;
      in_integers.origin[axis] = at;
      in_integers.direction[axis] = std::int64_t{way} << (bits.slope - 2);
      in_integers.negative[axis] = way < 0;
      in_floats.origin[static_cast<int>(axis)] = static_cast<float>(at) * 0.5F;
      in_floats.direction[static_cast<int>(axis)] = static_cast<float>(way) * 0.25F;
    }
    while (std::abs(in_integers.direction[static_cast<std::size_t>(in_integers.major)]) >> bits.slope == 0)
      ++in_integers.major;
    const auto right = crossing_of(in_integers, triangle, bits);
    const auto found = float_crossing({corners[0], corners[1], corners[2]}, in_floats);
    ASSERT_EQ(right.has_value(), found.has_value()) << i;
    if (!right) continue;
    ASSERT_EQ(right->side, found->side) << i;
    ASSERT_EQ(right->tie, found->tie) << i;
    ASSERT_EQ(right->once, found->once) << i;
    ties += found->tie ? 1 : 0;
    not_once += found->once ? 0 : 1;
  }
  EXPECT_GT(ties, 1'000);
  EXPECT_GT(not_once, 500);
}

TEST(FloatCrossing, IsAHitOfTheTriangleTest) {
  cases::Random random(64);
  int found = 0;
  for (const cases::ShotCategory& category : cases::shot_categories) {
    for (int i = 0; i < 3'000; ++i) {
      const cases::Shot s = category.make(random);
      Hit hit;
      const bool met = intersect_triangle(cases::single(s.corners), 0, s.ray, hit);
      const auto crossing = float_crossing(s.corners, s.ray);
      ASSERT_EQ(crossing.has_value(), met) << category.name << ": " << cases::describe(s);
      if (!met) continue;
      ++found;
      ASSERT_EQ(crossing->t.low, hit.t_low);
      ASSERT_EQ(crossing->t.high, hit.t_high);
      ASSERT_TRUE(crossing->tie || crossing->once);
      ASSERT_NE(crossing->side, 0);
    }
  }
  EXPECT_GT(found, 3'000);
}

}  // namespace
}  // namespace hitpipe::ref::float_crossing_test
