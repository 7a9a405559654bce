// Exactly once: the rule against a line that is moved in exact integers, and closed meshes that it must cross
// evenly where a closed triangle test alone, or a rule that is a little different, does not.
#include "rays/world/crossing.hpp"

#include <utility>

#include <gtest/gtest.h>

#include "tests/rays/exact/rational.hpp"
#include "tests/rays/world/tetrahedra.hpp"

namespace hitpipe::ref::crossing_test {
namespace {

using hls::WorldBits;
using oracle::Integer;
using tetrahedra::boundary;
using tetrahedra::draw_ray;
using tetrahedra::draw_solid;
using tetrahedra::oriented_boundary;
using tetrahedra::Solid;
using tetrahedra::turned;
using world_cases::Draw;

Integer wide(Int128 x) {
  const auto size = static_cast<Uint128>(x < 0 ? -x : x);
  const Integer made =
      (Integer(static_cast<std::uint64_t>(size >> 64)) << 64) + Integer(static_cast<std::uint64_t>(size));
  return x < 0 ? Integer(-made) : made;
}

template <class Number>
int sign_of(const Number& x) {
  return (x > 0 ? 1 : 0) - (x < 0 ? 1 : 0);
}

/// Corners in slots m, a and b, seen from the ray; A_i = 2^S a_i - s_a m_i, and B_i likewise.
struct Seen {
  std::array<Int128, 3> m, a, b, A, B;
  Int128 slope_a, slope_b;
  int turns = 1;  ///< -1: a determinant in slots has the other sign than in the world
};

Seen seen(const IntRay& ray, const IntTriangle& triangle, const WorldBits& bits) {
  const std::array<std::size_t, 3> slots = ray.major == 0   ? std::array<std::size_t, 3>{0, 1, 2}
                                           : ray.major == 1 ? std::array<std::size_t, 3>{1, 0, 2}
                                                            : std::array<std::size_t, 3>{2, 1, 0};
  const bool back = ray.direction[slots[0]] < 0;
  Seen made{};
  made.slope_a = back ? -ray.direction[slots[1]] : ray.direction[slots[1]];
  made.slope_b = back ? -ray.direction[slots[2]] : ray.direction[slots[2]];
  made.turns = back != (ray.major != 0) ? -1 : 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto from_origin = [&](std::size_t slot) -> Int128 {
      return (std::int64_t{triangle.corners[i][slots[slot]]} << bits.finer) - ray.origin[slots[slot]];
    };
    made.m[i] = from_origin(0);
    made.a[i] = from_origin(1);
    made.b[i] = from_origin(2);
    made.A[i] = (made.a[i] << bits.slope) - made.slope_a * made.m[i];
    made.B[i] = (made.b[i] << bits.slope) - made.slope_b * made.m[i];
  }
  return made;
}

/// Does the line, with A less by eps and B less by eps^2, meet the triangle? The sign of det in slots; 0: no.
/// eps is 2^-140, and all is in units of eps^2. Without the move e_i is a whole number below 2^124 in size, and the
/// factors of eps and eps^2 are below 2^63, so no sum of smaller terms reaches a larger one.
int side_of_moved(const Seen& s) {
  const auto moved = [&](std::size_t j, std::size_t k) -> Integer {
    constexpr unsigned eps = 140;
    std::array<Integer, 2> a, b;
    for (std::size_t each = 0; each < 2; ++each) {
      const std::size_t corner = each == 0 ? j : k;
      const Integer one = Integer(1) << (2 * eps);
      a[each] = wide(s.A[corner]) * one - (one >> eps);
      b[each] = wide(s.B[corner]) * one - (one >> (2 * eps));
    }
    return a[0] * b[1] - a[1] * b[0];
  };
  const std::array<int, 3> sides{sign_of(moved(1, 2)), sign_of(moved(2, 0)), sign_of(moved(0, 1))};
  return sides[0] == sides[1] && sides[1] == sides[2] ? sides[0] : 0;
}

/// Rules that are a little different.
enum class Fault {
  none,
  closed,          ///< a tie always counts
  one_component,   ///< the move has no second part: then it counts
  fixed_answer,    ///< likewise: then it does not
  turning_order,   ///< the order of the two components turns with the edge
  own_components,  ///< the edge's own components in place of those that the ray sees
};

/// The rule by components, as a line has it whose T may be negative. The sign of det in slots; 0: no crossing.
int side_by_rule(const Seen& s, Fault fault) {
  std::array<Int128, 3> e{};
  Int128 det = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    e[i] = s.A[j] * s.B[k] - s.A[k] * s.B[j];
    det += e[i];
  }
  const int side = sign_of(det);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
    const bool own = fault == Fault::own_components;
    int first = sign_of(own ? s.b[j] - s.b[k] : s.B[j] - s.B[k]);
    int second = sign_of(own ? s.a[k] - s.a[j] : s.A[k] - s.A[j]);
    if (fault == Fault::closed) first = second = side;
    if (fault == Fault::one_component) second = side;
    if (fault == Fault::fixed_answer) second = -side;
    if (fault == Fault::turning_order) first = std::abs(first);
    int where = sign_of(e[i]);
    if (where == 0) where = first;
    if (where == 0) where = second;
    if (where == 0) where = side;
    if (where != side) return 0;
  }
  return side;
}

/// The closed meshes of a test: calls test(solid, mesh, ray).
template <class Test>
void for_each_case(std::uint64_t seed, int cases, std::vector<IntTriangle> (*mesh_of)(const Solid&),
                   const Test& test) {
  Draw draw(seed);
  for (int i = 0; i < cases; ++i) {
    const Solid solid = draw_solid(draw, 4);
    const std::vector<IntTriangle> mesh = mesh_of(solid);
    if (mesh.empty()) continue;
    if (const auto ray = draw_ray(draw, solid.bits, mesh)) test(solid, mesh, *ray);
  }
}

/// By triangle, of a whole line. A triangle that both halves cross, at the origin, is crossed once.
struct LineCount {
  int crossings = 0;
  int sides = 0;  ///< as the first half sees them
};

LineCount line_count(const IntRay& ray, const std::vector<IntTriangle>& mesh, const WorldBits& bits) {
  LineCount sum;
  for (const IntTriangle& triangle : mesh) {
    const auto ahead = crossing_of(ray, triangle, bits);
    const auto behind = crossing_of(turned(ray), triangle, bits);
    if (ahead && behind) {
      EXPECT_EQ(ahead->once, behind->once);
      EXPECT_EQ(ahead->side, -behind->side);
    }
    const bool crossed = (ahead && ahead->once) || (behind && behind->once);
    if (!crossed) continue;
    ++sum.crossings;
    sum.sides += ahead ? ahead->side : -behind->side;
  }
  return sum;
}

TEST(Crossing, IsWhereTheMovedLineMeetsTheTriangle) {
  int ties = 0, counted = 0, hits = 0;
  const auto compare = [&](const IntRay& ray, const IntTriangle& triangle, const WorldBits& bits) {
    const auto closed = int_crossing(ray, triangle, bits);
    const auto found = crossing_of(ray, triangle, bits);
    ASSERT_EQ(found.has_value(), closed.has_value());
    if (!found) return;
    ++hits;
    const Seen s = seen(ray, triangle, bits);
    const int moved = side_of_moved(s);
    ASSERT_EQ(found->once, moved != 0);
    ASSERT_EQ(found->t, closed->t);
    ASSERT_EQ(found->tie, closed->e[0] == 0 || closed->e[1] == 0 || closed->e[2] == 0);
    ASSERT_TRUE(found->tie || found->once);
    ASSERT_EQ(moved, side_by_rule(s, Fault::none));
    if (found->once) {
      ASSERT_EQ(found->side, moved * s.turns);
    }
    ties += found->tie ? 1 : 0;
    counted += found->tie && found->once ? 1 : 0;
  };
  for_each_case(39101, 100'000, boundary, [&](const Solid& solid, const auto& mesh, const IntRay& ray) {
    for (const IntTriangle& triangle : mesh) compare(ray, triangle, solid.bits);
  });
  Draw draw(39102);
  for (int i = 0; i < 100'000; ++i) {
    const world_cases::Case c = draw.next();
    compare(c.ray, c.triangle, c.bits);
  }
  EXPECT_GT(hits, 30'000);
  EXPECT_GT(ties, 10'000);
  EXPECT_GT(counted, 2'000);
  EXPECT_GT(ties - counted, 2'000);
}

TEST(Crossing, ALineCrossesAClosedMeshEvenly) {
  int crossed = 0;
  for_each_case(39104, 150'000, boundary, [&](const Solid& solid, const auto& mesh, const IntRay& ray) {
    const LineCount line = line_count(ray, mesh, solid.bits);
    ASSERT_EQ(line.crossings % 2, 0);
    crossed += line.crossings > 0 ? 1 : 0;
  });
  EXPECT_GT(crossed, 60'000);
}

TEST(Crossing, ALineCrossesAnOrientedMeshAsOftenFromEitherSide) {
  int crossed = 0;
  for_each_case(39105, 150'000, oriented_boundary,
                [&](const Solid& solid, const auto& mesh, const IntRay& ray) {
                  const LineCount line = line_count(ray, mesh, solid.bits);
                  ASSERT_EQ(line.sides, 0);
                  crossed += line.crossings > 0 ? 1 : 0;
                });
  EXPECT_GT(crossed, 60'000);
}

TEST(Crossing, AnOddCountIsAnOriginInside) {
  int inside = 0, outside = 0;
  for_each_case(39106, 150'000, boundary, [&](const Solid& solid, const auto& mesh, const IntRay& ray) {
    const std::optional<bool> wanted = tetrahedra::inside(solid, ray.origin);
    if (!wanted) return;
    for (const IntRay& half : {ray, turned(ray)}) {
      int count = 0;
      for (const IntTriangle& triangle : mesh) {
        const auto found = crossing_of(half, triangle, solid.bits);
        count += found && found->once ? 1 : 0;
      }
      ASSERT_EQ(count % 2 != 0, *wanted);
    }
    ++(*wanted ? inside : outside);
  });
  EXPECT_GT(inside, 1'000);
  EXPECT_GT(outside, 20'000);
}

/// In the plane x = 10, of which a ray along x sees y and z.
IntTriangle flat(const std::array<std::array<std::int32_t, 2>, 3>& yz) {
  IntTriangle made;
  for (std::size_t i = 0; i < 3; ++i) made.corners[i] = {10, yz[i][0], yz[i][1]};
  return made;
}

const WorldBits small{12, 1, 12, 0};

IntRay along_x(std::int64_t y, std::int64_t z, bool back) {
  return {.origin = {back ? 40 : 0, y, z},
          .direction = {back ? -(1 << 12) : 1 << 12, 0, 0},
          .negative = {back, false, false},
          .major = 0,
          .length = small.largest_distance()};
}

/// The ray is moved toward y, and less toward z. Slots do not turn with its direction.
TEST(Crossing, OfAFanOneTriangleHasTheCorner) {
  const std::array fan{flat({{{0, 0}, {8, 0}, {0, 8}}}), flat({{{0, 0}, {0, 8}, {-8, 0}}}),
                       flat({{{0, 0}, {-8, 0}, {0, -8}}}), flat({{{0, 0}, {0, -8}, {8, 0}}})};
  for (const bool back : {false, true})
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const auto at_corner = crossing_of(along_x(0, 0, back), fan[i], small);
      ASSERT_TRUE(at_corner);
      EXPECT_TRUE(at_corner->tie);
      EXPECT_EQ(at_corner->once, i == 0) << i;
      EXPECT_EQ(at_corner->side, back ? -1 : 1);
    }
  // At half of the edge toward z, which the first two share.
  EXPECT_TRUE(crossing_of(along_x(0, 8, false), fan[0], small)->once);
  EXPECT_FALSE(crossing_of(along_x(0, 8, false), fan[1], small)->once);
}

TEST(Crossing, TwoOfATriangleCountTwiceAndOppositeOnesCancel) {
  const IntTriangle triangle = flat({{{0, 0}, {8, 0}, {0, 8}}});
  const IntTriangle opposite{{triangle.corners[0], triangle.corners[2], triangle.corners[1]}};
  for (const auto& [y, z] : {std::pair{0, 0}, {8, 0}, {4, 4}, {16, 0}, {8, 8}}) {
    const LineCount twice = line_count(along_x(y, z, false), {triangle, triangle}, small);
    EXPECT_EQ(twice.crossings % 2, 0);
    EXPECT_EQ(twice.sides, twice.crossings);
    const LineCount both = line_count(along_x(y, z, false), {triangle, opposite}, small);
    EXPECT_EQ(both.crossings, twice.crossings);
    EXPECT_EQ(both.sides, 0);
  }
}

/// As long as T is at most the length, and from an origin in the triangle on.
TEST(Crossing, CountsFromTheOriginToTheLength) {
  const IntTriangle triangle = flat({{{0, 0}, {8, 0}, {0, 8}}});
  IntRay ray = along_x(3, 3, false);
  ray.length = 20;
  EXPECT_EQ(crossing_of(ray, triangle, small)->t, 20);
  ray.length = 19;
  EXPECT_FALSE(crossing_of(ray, triangle, small));
  ray.origin[0] = 20;
  EXPECT_TRUE(crossing_of(ray, triangle, small)->once);
  EXPECT_TRUE(crossing_of(turned(ray), triangle, small)->once);
  ray.origin[0] = 21;
  EXPECT_FALSE(crossing_of(ray, triangle, small));
}

class CrossingFaults : public testing::TestWithParam<std::pair<const char*, Fault>> {};

TEST_P(CrossingFaults, GiveOddLines) {
  int odd_lines = 0;
  for_each_case(39107, 150'000, boundary, [&](const Solid& solid, const auto& mesh, const IntRay& ray) {
    int crossings = 0;
    for (const IntTriangle& triangle : mesh)
      crossings += side_by_rule(seen(ray, triangle, solid.bits), GetParam().second) != 0 ? 1 : 0;
    odd_lines += crossings % 2;
  });
  if (GetParam().second == Fault::none) {
    EXPECT_EQ(odd_lines, 0);
  } else {
    EXPECT_GT(odd_lines, 100);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, CrossingFaults,
                         testing::Values(std::pair{"nothing", Fault::none},
                                         std::pair{"closed", Fault::closed},
                                         std::pair{"one_component", Fault::one_component},
                                         std::pair{"fixed_answer", Fault::fixed_answer},
                                         std::pair{"turning_order", Fault::turning_order},
                                         std::pair{"own_components", Fault::own_components}),
                         [](const auto& one) { return one.param.first; });

}  // namespace
}  // namespace hitpipe::ref::crossing_test
