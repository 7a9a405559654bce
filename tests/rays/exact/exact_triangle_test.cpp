// The triangle test against rational arithmetic, by category of triangle_cases.hpp.
#include "rays/exact/exact_triangle.hpp"

#include <algorithm>
#include <limits>
#include <optional>

#include <gtest/gtest.h>

#include "tests/rays/exact/triangle_cases.hpp"

namespace hitpipe::ref::exact_triangle_test {
namespace {

using cases::Random;
using cases::Rational;
using cases::Shot;

constexpr std::uint64_t seed = 20052;

void expect_rational(const Shot& s, const std::optional<Rational>& t, triangle_filter::Verdict verdict) {
  Hit hit;
  ASSERT_EQ(intersect_triangle(cases::single(s.corners), 0, s.ray, hit), t.has_value());
  ASSERT_EQ(hit.found(), t.has_value());
  if (!t) return;
  ASSERT_NE(verdict, triangle_filter::Verdict::miss);
  ASSERT_LE(cases::exact(hit.t_low), *t);
  ASSERT_GE(cases::exact(hit.t_high), *t);
  ASSERT_GE(cases::exact(std::min<double>(cull_length(hit), 1e300)), *t);
  triangle_filter::Enclosure tight{};
  ASSERT_TRUE(triangle_filter::enclose_exactly(s.corners, s.ray, tight));
  ASSERT_LE(cases::exact(tight.low), *t);
  ASSERT_GE(cases::exact(tight.high), *t);
  ASSERT_LE(tight.high, std::nextafter(tight.low, std::numeric_limits<double>::infinity()));
}

TEST(TriangleTest, MatchesRationalArithmetic) {
  constexpr int cases_per_category = 8'000;
  Random random(seed);
  int hits_in_all = 0;
  int doubts_in_all = 0;
  int doubts_of_random = 0;
  for (const cases::ShotCategory& category : cases::shot_categories) {
    int hits = 0;
    int doubts = 0;
    for (int i = 0; i < cases_per_category; ++i) {
      const Shot s = category.make(random);
      const std::optional<Rational> t = cases::time_of_hit(s.corners, s.ray);
      triangle_filter::Enclosure enclosure{};
      const auto verdict = triangle_filter::classify(s.corners, s.ray, enclosure);
      ASSERT_NO_FATAL_FAILURE(expect_rational(s, t, verdict)) << category.name << ": " << cases::describe(s);
      doubts += verdict == triangle_filter::Verdict::doubt ? 1 : 0;
      hits += t ? 1 : 0;
    }
    hits_in_all += hits;
    doubts_in_all += doubts;
    const bool in_plane = category.make == cases::coplanar_shot;
    EXPECT_TRUE(in_plane ? hits == 0 : hits > cases_per_category / 50) << category.name;
    if (category.make == cases::random_shot) doubts_of_random = doubts;
  }
  const int total = cases_per_category * static_cast<int>(cases::shot_categories.size());
  EXPECT_GT(hits_in_all, total / 5);
  EXPECT_GT(doubts_in_all, total / 20);
  EXPECT_LT(doubts_of_random, 3);
}

/// No double is between it and the number that is not nearer to 0.
void expect_rounded_to_zero(double value, const Rational& rational) {
  const double size = std::abs(value);
  ASSERT_LE(cases::exact(size), abs(rational)) << value;
  const double next = std::nextafter(size, std::numeric_limits<double>::max());
  ASSERT_GT(cases::exact(next), abs(rational)) << value;
}

void scale(Shot& s, float factor) {
  for (glm::vec3* v : {&s.corners.a, &s.corners.b, &s.corners.c, &s.ray.origin}) *v *= factor;
}

TEST(PlanePoint, MatchesRationalArithmetic) {
  Random random(seed);
  int negative = 0;
  for (const cases::ShotCategory& category : cases::shot_categories) {
    for (int i = 0; i < 500; ++i) {
      Shot s = category.make(random);
      if (i % 4 == 1) scale(s, std::ldexp(1.0F, 20 - random.between(0, 120)));
      const glm::vec3 longer = s.ray.direction * std::ldexp(1.0F, 20 - random.between(0, 40));
      if (i % 4 == 2 && std::isfinite(longer.x + longer.y + longer.z))
        s.ray.direction = cases::nonzero(longer);
      const std::array corner{cases::exact(s.corners.a), cases::exact(s.corners.b),
                              cases::exact(s.corners.c)};
      const auto normal =
          cases::cross(cases::minus(corner[1], corner[0]), cases::minus(corner[2], corner[0]));
      const cases::RationalVec origin = cases::exact(s.ray.origin);
      const cases::RationalVec direction = cases::exact(s.ray.direction);
      const Rational slope = cases::dot(normal, direction);
      const auto point = plane_point(s.corners, s.ray);
      ASSERT_EQ(plane_distance(s.corners, s.ray), point ? std::optional(point->t) : std::nullopt);
      ASSERT_EQ(point.has_value(), slope != 0) << category.name;
      if (!point) continue;
      const Rational t = cases::dot(normal, cases::minus(corner[0], origin)) / slope;
      ASSERT_NO_FATAL_FAILURE(expect_rounded_to_zero(point->t, t)) << cases::describe(s);
      const cases::RationalVec place{origin[0] + t * direction[0], origin[1] + t * direction[1],
                                     origin[2] + t * direction[2]};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto opposite =
            cases::cross(cases::minus(corner[(k + 1) % 3], place), cases::minus(corner[(k + 2) % 3], place));
        const Rational weight = cases::dot(opposite, normal) / cases::dot(normal, normal);
        ASSERT_NO_FATAL_FAILURE(expect_rounded_to_zero(point->weights[k], weight)) << cases::describe(s);
        ASSERT_EQ(std::signbit(point->weights[k]), weight < 0);
        negative += weight < 0 ? 1 : 0;
      }
    }
  }
  EXPECT_GT(negative, 100);
}

constexpr Mesh::Corners right_angle{{0, 0, 0}, {0.5F, 0, 0}, {0, 0.5F, 0}};

TEST(TriangleTest, BothFacesHit) {
  const Mesh mesh = cases::single(right_angle);
  for (const float side : {-0.5F, 0.5F}) {
    Hit hit;
    EXPECT_TRUE(intersect_triangle(mesh, 0, {{0.125F, 0.125F, side}, {0, 0, -side}, Ray::infinite}, hit));
    EXPECT_LE(hit.t_low, 1.0);
    EXPECT_GE(hit.t_high, 1.0);
    EXPECT_LT(hit.t_high - hit.t_low, 1e-13);
  }
}

TEST(TriangleTest, TriangleWithoutAreaNeverHits) {
  Hit hit;
  const Mesh mesh = cases::single({{0, 0, 0}, {0.25F, 0, 0}, {0.5F, 0, 0}});
  EXPECT_FALSE(intersect_triangle(mesh, 0, {{0.25F, 0, 0.5F}, {0, 0, -1}, Ray::infinite}, hit));
}

TEST(TriangleTest, TestingTheSameTriangleTwiceChangesNothing) {
  Hit hit;
  const Mesh mesh = cases::single(right_angle);
  const Ray ray{{0.125F, 0.125F, 0.5F}, {0, 0, -1}, Ray::infinite};
  EXPECT_TRUE(intersect_triangle(mesh, 0, ray, hit));
  EXPECT_FALSE(intersect_triangle(mesh, 0, ray, hit));
}

TEST(CullLength, IsTheLeastFloatNotBelowT) {
  const auto of = [](double t_high) { return cull_length(Hit{0, 0.0, t_high}); };
  EXPECT_EQ(of(0.0), 0.0F);
  EXPECT_EQ(of(1.0), 1.0F);
  EXPECT_EQ(of(std::nextafter(1.0, 2.0)), std::nextafter(1.0F, 2.0F));
  EXPECT_EQ(of(0x1p-400), 0x1p-149F);
  EXPECT_EQ(of(0x1.8p-149), 0x1p-148F);
  EXPECT_EQ(of(0x1.fffffep127), 0x1.fffffep127F);
  EXPECT_EQ(of(0x1.fffffe00001p127), Ray::infinite);
  EXPECT_EQ(of(0x1p200), Ray::infinite);
  EXPECT_EQ(cull_length(Hit{}), Ray::infinite);
  Random random(seed + 5);
  for (int i = 0; i < 100'000; ++i) {
    const double t =
        std::ldexp(1.5 + 0.5 * static_cast<double>(random.signed_unit()), random.between(-150, 126));
    ASSERT_GE(static_cast<double>(of(t)), t);
    ASSERT_LT(static_cast<double>(cases::nudged(of(t), -1)), t);
  }
}

TEST(HasArea, MatchesRationalArithmetic) {
  Random random(seed + 6);
  int without = 0;
  for (int i = 0; i < 40'000; ++i) {
    const glm::vec3 scale(std::ldexp(1.0F, -random.between(0, 140)));
    Mesh::Corners c = cases::coarse_triangle(random);
    if (random.coin()) c.c = c.a + (c.b - c.a) * (static_cast<float>(random.between(-2, 4)) * 0.25F);
    c = {c.a * scale, c.b * scale, c.c * scale};
    if (random.coin()) {
      float& x = c.b[random.axis()];
      x = cases::nudged(x, random.between(-1, 1));
    }
    if (random.below(4) == 0) {
      // On one line, but so far apart in magnitude that double rounds the differences.
      const glm::vec3 line(1, 3, 5);
      const auto step = [&] { return 0x1p-9F * static_cast<float>(random.between(-63, 63)); };
      c = {line * (step() * std::ldexp(1.0F, -random.between(40, 60))), line * step(), line * step()};
    }
    const cases::RationalVec normal = cases::cross(cases::minus(cases::exact(c.b), cases::exact(c.a)),
                                                   cases::minus(cases::exact(c.c), cases::exact(c.a)));
    const bool expected = normal[0] != 0 || normal[1] != 0 || normal[2] != 0;
    ASSERT_EQ(has_area(c), expected) << cases::describe({c, {}});
    without += expected ? 0 : 1;
  }
  EXPECT_GT(without, 4'000);
  EXPECT_LT(without, 36'000);
}

/// Corners in double: on a line, or nudged off it by one unit in the last place, of any magnitude.
TEST(HasArea, OfDoublesIsThatOfRationals) {
  Random random(seed + 7);
  int without = 0;
  for (int i = 0; i < 20'000; ++i) {
    const auto number = [&] { return static_cast<double>(random.between(-9, 9)); };
    SourceMesh::Corners c{{number(), number(), number()}, {number(), number(), number()}, {}};
    const double along = static_cast<double>(random.between(-2, 4)) * 0.25;
    c.c = c.a + (c.b - c.a) * along;
    const double scale = std::ldexp(1.0, random.between(-1070, 120));
    for (glm::dvec3* const corner : {&c.a, &c.b, &c.c}) *corner *= scale;
    if (random.coin()) {
      double& x = c.b[random.axis()];
      x = std::nextafter(x, random.coin() ? HUGE_VAL : -HUGE_VAL);
    }
    const auto part = [&](const glm::dvec3& corner, int axis) {
      return cases::exact(corner[axis]) - cases::exact(c.a[axis]);
    };
    bool expected = false;
    for (int k = 0; k < 3; ++k) {
      const int j = (k + 1) % 3;
      expected = expected || part(c.b, k) * part(c.c, j) != part(c.b, j) * part(c.c, k);
    }
    ASSERT_EQ(has_area(c), expected) << i;
    without += expected ? 0 : 1;
  }
  EXPECT_GT(without, 2'000);
  EXPECT_LT(without, 18'000);
}

}  // namespace
}  // namespace hitpipe::ref::exact_triangle_test
