// The exact triangle test against rational arithmetic, and what is wanted of it at edges, corners and
// extremes.
#include "rays/world/int_triangle.hpp"

#include <cstdlib>
#include <string>

#include <gtest/gtest.h>

#include "tests/rays/world/cases.hpp"

namespace hitpipe::ref::int_triangle_test {
namespace {

using world_cases::Case;
using world_cases::Draw;
using world_cases::Rational;
using world_cases::truth;

Rational rational(Int128 x) {
  const bool negative = x < 0;
  const auto size = static_cast<Uint128>(negative ? -x : x);
  Rational made = oracle::Integer(static_cast<std::uint64_t>(size >> 64));
  made = made * oracle::Integer(oracle::Integer(1) << 64) + oracle::Integer(static_cast<std::uint64_t>(size));
  return negative ? Rational(-made) : made;
}

/// The long test asks for more than the usual number.
int cases() {
  const char* const asked = std::getenv("HITPIPE_WORLD_CASES");
  return asked != nullptr ? std::stoi(asked) : 60'000;
}

TEST(IntCrossing, IsTheTruth) {
  Draw draw(39001);
  const int tests = cases();
  int hits = 0, on_an_edge = 0, at_the_length = 0;
  for (int i = 0; i < tests; ++i) {
    Case c = draw.next();
    const auto exact = truth(c);
    if (exact && draw.one_in(4)) {  // the end of the ray is at the triangle, or one unit before it
      const auto t = static_cast<std::int64_t>(oracle::floor(exact->distance * (1 << c.bits.fraction)));
      c.ray.length = std::max<std::int64_t>(0, t - draw.integer(0, 1));
      ++at_the_length;
    }
    const auto found = int_crossing(c.ray, c.triangle, c.bits);
    const bool within = exact && oracle::floor(exact->distance * (1 << c.bits.fraction)) <= c.ray.length;
    ASSERT_EQ(found.has_value(), within) << "case " << i;
    if (!found) continue;
    ++hits;
    ASSERT_EQ(oracle::Integer(found->t), oracle::floor(exact->distance * (1 << c.bits.fraction)));
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_EQ(rational(found->e[k]) / rational(found->det), exact->weights[k]);
      on_an_edge += found->e[k] == 0 ? 1 : 0;
    }
  }
  EXPECT_GT(hits, tests * 2 / 15);
  EXPECT_GT(on_an_edge, tests / 85);
  EXPECT_GT(at_the_length, tests / 30);
}

TEST(IntCrossing, HasBothSidesAndAClosedEdge) {
  const hls::WorldBits bits{12, 1, 12, 0};
  const IntTriangle triangle{{{{10, 0, 0}, {10, 8, 0}, {10, 0, 8}}}};
  const IntTriangle turned{{triangle.corners[0], triangle.corners[2], triangle.corners[1]}};
  const auto along_x = [](std::int64_t y, std::int64_t z) {
    return IntRay{
        .origin = {0, y, z}, .direction = {1 << 12, 0, 0}, .negative = {}, .major = 0, .length = 1000};
  };
  for (const IntTriangle& each : {triangle, turned}) {
    for (const auto& [y, z] : {std::pair{0, 0}, {16, 0}, {0, 16}, {8, 8}, {8, 0}, {3, 3}})
      EXPECT_TRUE(int_crossing(along_x(y, z), each, bits)) << y << ' ' << z;
    for (const auto& [y, z] : {std::pair{-1, 0}, {17, 0}, {0, -1}, {9, 8}})
      EXPECT_FALSE(int_crossing(along_x(y, z), each, bits)) << y << ' ' << z;
  }
  IntRay ray = along_x(3, 3);
  EXPECT_EQ(int_crossing(ray, triangle, bits)->t, 20);
  ray.length = 20;
  EXPECT_TRUE(int_crossing(ray, triangle, bits));
  ray.length = 19;
  EXPECT_FALSE(int_crossing(ray, triangle, bits));
  ray = along_x(3, 3);
  ray.origin[0] = 20;
  EXPECT_EQ(int_crossing(ray, triangle, bits)->t, 0);
  ray.origin[0] = 21;
  EXPECT_FALSE(int_crossing(ray, triangle, bits));
}

TEST(IntCrossing, ARayInThePlaneNeverHits) {
  const hls::WorldBits bits{12, 0, 12, 0};
  const IntTriangle triangle{{{{10, 0, 5}, {10, 8, 5}, {20, 0, 5}}}};
  const IntRay ray{
      .origin = {0, 2, 5}, .direction = {1 << 12, 0, 0}, .negative = {}, .major = 0, .length = 4000};
  EXPECT_FALSE(int_crossing(ray, triangle, bits));
  EXPECT_FALSE(is_degenerate(triangle));
  const IntTriangle line{{{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}}};
  const IntTriangle point{{{{7, 7, 7}, {7, 7, 7}, {7, 7, 7}}}};
  EXPECT_TRUE(is_degenerate(line));
  EXPECT_TRUE(is_degenerate(point));
}

TEST(IntHit, IsTheLeastDistanceThenTheLowestNumber) {
  IntHit best;
  EXPECT_TRUE(keep_better(7, 5, best));
  EXPECT_FALSE(keep_better(7, 6, best));
  EXPECT_TRUE(keep_better(7, 4, best));
  EXPECT_FALSE(keep_better(8, 1, best));
  EXPECT_TRUE(keep_better(6, 9, best));
  EXPECT_EQ(best.triangle, 9U);
  EXPECT_EQ(best.t, 6);
}

}  // namespace
}  // namespace hitpipe::ref::int_triangle_test
