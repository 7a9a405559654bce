// Triangles of polygons: their number, and by rational numbers that they cover what the polygon covers.
#include "rays/files/polygon.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include <boost/multiprecision/cpp_int.hpp>
#include <glm/vec2.hpp>
#include <gtest/gtest.h>

namespace hitpipe::ref::polygon_test {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Corners = std::vector<glm::dvec3>;
using Triangles = std::vector<std::array<std::uint32_t, 3>>;

const std::string crossing = "crosses itself or covers an area twice";

std::string cut(const Corners& corners, Triangles& triangles) {
  std::vector<std::uint32_t> places(corners.size());
  std::iota(places.begin(), places.end(), 0U);
  return triangulate(corners, places, triangles);
}

/// Twice the signed area, seen along z.
Rational area(const Corners& corners) {
  Rational sum = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3& p = corners[i];
    const glm::dvec3& q = corners[(i + 1) % corners.size()];
    sum += Rational(p.x) * Rational(q.y) - Rational(p.y) * Rational(q.x);
  }
  return sum;
}

/// Checks number, signs and sum of areas of a polygon that is not refused and is seen along z.
Triangles expect_exact(const Corners& corners) {
  Triangles triangles;
  EXPECT_EQ(cut(corners, triangles), "");
  EXPECT_EQ(triangles.size(), corners.size() - 2);
  const Rational whole = area(corners);
  Rational sum = 0;
  for (const auto& [a, b, c] : triangles) {
    const Rational part = area({corners[a], corners[b], corners[c]});
    EXPECT_GE(whole < 0 ? Rational(-part) : part, 0);
    sum += part;
  }
  EXPECT_EQ(sum, whole);
  return triangles;
}

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// How often a walk goes around a point that is on no edge. Exact enough for small integers as corners.
int winding_at(const Corners& corners, const glm::dvec2& point) {
  int number = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 p(corners[i]);
    const glm::dvec2 q(corners[(i + 1) % corners.size()]);
    if ((p.x < point.x) == (q.x < point.x)) continue;
    const bool rightward = p.x < point.x;
    if ((cross(p, q, point) > 0) == rightward) number += rightward ? -1 : 1;  // it lies above
  }
  return number;
}

std::vector<glm::dvec2> samples(int side) {
  std::vector<glm::dvec2> points;
  for (int x = 0; x < 6 * side; ++x)
    for (int y = 0; y < 6 * side; ++y)
      points.emplace_back(x / 6.0 + 0.0617 + 0.00137 * y, y / 6.0 + 0.0531 + 0.00171 * x);
  return points;
}

Corners on_grid(std::mt19937& random, int side, std::size_t n) {
  Corners corners(n);
  for (glm::dvec3& p : corners) {
    const auto place = static_cast<int>(random() % static_cast<unsigned>(side * side));
    p = {place % side, place / side, 0};
  }
  return corners;
}

void expect_covered(const Corners& corners, const Triangles& triangles,
                    const std::vector<glm::dvec2>& points) {
  for (const glm::dvec2& point : points) {
    int covers = 0;
    for (const auto& [a, b, c] : triangles) covers += winding_at({corners[a], corners[b], corners[c]}, point);
    ASSERT_EQ(covers, winding_at(corners, point)) << point.x << " " << point.y;
    ASSERT_LE(std::abs(covers), 1);
  }
}

TEST(Polygon, CornerOnTheLineOfAnotherEdge) {
  const Triangles triangles = expect_exact({{0, 1, 0}, {3, 2, 0}, {2, 3, 0}, {1, 2, 0}, {0, 2, 0}});
  EXPECT_EQ(triangles.size(), 3U);
}

TEST(Polygon, EveryWalkOfFiveCornersOnAGridOfNine) {
  const std::vector<glm::dvec2> points = samples(2);
  int taken = 0;
  for (int walk = 0; walk < 59049; ++walk) {
    Corners corners(5);
    for (int i = 0, rest = walk; i < 5; ++i, rest /= 9)
      corners[static_cast<std::size_t>(i)] = {rest % 3, rest % 9 / 3, 0};
    Triangles triangles;
    if (!cut(corners, triangles).empty()) {
      EXPECT_TRUE(triangles.empty());
      continue;
    }
    ++taken;
    ASSERT_EQ(triangles.size(), 3U);
    const double whole = static_cast<double>(area(corners));
    for (const auto& [a, b, c] : triangles) {
      const double part = cross(glm::dvec2(corners[a]), glm::dvec2(corners[b]), glm::dvec2(corners[c]));
      ASSERT_GE(part * whole, 0.0);
      ASSERT_TRUE(whole != 0.0 || part == 0.0);
    }
    if (walk % 16 == 0) expect_covered(corners, triangles, points);
  }
  EXPECT_EQ(taken, 40689);
}

TEST(Polygon, RandomWalksOnAGrid) {
  std::mt19937 random(1);
  const std::vector<glm::dvec2> points = samples(3);
  int taken = 0;
  for (int i = 0; i < 3000; ++i) {
    const Corners corners = on_grid(random, 4, 5 + random() % 5);
    Triangles triangles;
    if (!cut(corners, triangles).empty()) continue;
    ++taken;
    expect_exact(corners);
    expect_covered(corners, triangles, points);
  }
  EXPECT_GT(taken, 500);
}

/// Whether no two edges that are not neighbours cross.
bool is_simple(const std::vector<glm::dvec2>& p) {
  const std::size_t n = p.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j + 1 == n) continue;
      const glm::dvec2& a = p[i];
      const glm::dvec2& b = p[i + 1];
      const glm::dvec2& c = p[j];
      const glm::dvec2& d = p[(j + 1) % n];
      if (cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0) return false;
    }
  }
  return true;
}

/// The corners, and each point of the grid that an edge passes.
std::vector<glm::dvec2> with_passed_points(const Corners& corners, int side) {
  std::vector<glm::dvec2> all;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec2 p(corners[i]);
    const glm::dvec2 step = glm::dvec2(corners[(i + 1) % corners.size()]) - p;
    for (int k = 0; k < side * side; ++k) {
      const glm::dvec2 q = p + step * (k / static_cast<double>(side * side));
      if (k == 0 || (std::abs(q.x - std::round(q.x)) < 1e-9 && std::abs(q.y - std::round(q.y)) < 1e-9))
        all.push_back(q);
    }
  }
  return all;
}

TEST(Polygon, NoneIsRefusedThatIsSimpleAfterASmallMove) {
  std::mt19937 random(2);
  std::size_t refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const Corners corners = on_grid(random, 3, 5 + random() % 2);
    Triangles triangles;
    if (cut(corners, triangles).empty()) continue;
    ++refused;
    const std::vector<glm::dvec2> all = with_passed_points(corners, 3);
    for (int trial = 0; trial < 100; ++trial) {
      std::vector<glm::dvec2> moved = all;
      for (glm::dvec2& p : moved)
        p += glm::dvec2(static_cast<double>(random() % 2001), static_cast<double>(random() % 2001)) * 1e-6 -
             1e-3;
      ASSERT_FALSE(is_simple(moved));
    }
  }
  EXPECT_GT(refused, 500U);
}

TEST(Polygon, StarsOfAnyDoubles) {
  std::mt19937 random(3);
  for (int star = 0; star < 200; ++star) {
    Corners corners;
    const int n = 4 + static_cast<int>(random() % 60);
    for (int i = 0; i < n; ++i) {
      const double angle = (star % 2 == 0 ? 2 : -2) * std::numbers::pi * i / n;
      const double radius = 0.1 + static_cast<double>(random() % 1000) / 1000.0;
      const double x = 1e3 + radius * std::cos(angle);
      const double y = radius * std::sin(angle);
      corners.emplace_back(x, y, 0.5 * x - 0.25 * y);
    }
    expect_exact(corners);
  }
}

TEST(Polygon, HolesAreJoinedByEdgesThatAreWalkedTwice) {
  Corners corners{{0, 0, 0}, {9, 0, 0}, {9, 9, 0}, {0, 9, 0}};
  for (const double y : {7.0, 4.0, 1.0}) {
    for (const glm::dvec3& p :
         Corners{{0, y, 0}, {1, y, 0}, {2, y + 1, 0}, {3, y, 0}, {2, y - 1, 0}, {1, y, 0}})
      corners.push_back(p);
    corners.emplace_back(0, y, 0);
  }
  const Triangles triangles = expect_exact(corners);
  expect_covered(corners, triangles, samples(9));
  EXPECT_EQ(winding_at(corners, {2.01, 4.02}), 0);
  // And a hole in the very corner of its outline.
  expect_exact({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {0, 0, 0}, {0, 2, 0}, {2, 0, 0}});
}

TEST(Polygon, TouchesItselfInACorner) {
  expect_exact({{0, 0, 0}, {2, 0, 0}, {1, 1, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0}});
  expect_exact({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}, {0, 4, 0}});
}

TEST(Polygon, AnEdgeFromTheRimOfATriangleIsSeen) {
  expect_exact({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {2, 2, 0}, {0, 0, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});
  expect_exact({{1, 1, 0}, {0, 1, 0}, {1, 2, 0}, {2, 2, 0}, {0, 1, 0}, {2, 1, 0}, {2, 1, 0}, {2, 0, 0}});
}

TEST(Polygon, ACornerThatEdgesWalkedTwiceHideIsNoEar) {
  expect_exact(
      {{1, 1, 0}, {1, 2, 0}, {0, 0, 0}, {1, 3, 0}, {1, 2, 0}, {1, 1, 0}, {3, 3, 0}, {3, 2, 0}, {2, 2, 0}});
}

TEST(Polygon, CornersInARowAndTwiceInOnePlace) {
  expect_exact({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {3, 1, 0}, {3, 3, 0}, {0, 3, 0}});
  expect_exact({{0, 0, 0}, {0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {3, 3, 0}, {3, 3, 0}, {0, 3, 0}});
  // With a better cut there, no triangle of a polygon with a corner in a row lacks area.
  const Corners row{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 9, 0}};
  for (const auto& [a, b, c] : expect_exact(row)) EXPECT_NE(area({row[a], row[b], row[c]}), 0);
}

TEST(Polygon, OnALineHasTrianglesWithoutArea) {
  for (const Corners& corners :
       {Corners{{0, 0, 0}, {1, 1, 1}, {3, 3, 3}, {2, 2, 2}, {5, 5, 5}}, Corners(6, glm::dvec3(1, 2, 3)),
        Corners{{0, 0, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, 3}}})
    expect_exact(corners);
  Triangles triangles;
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}}, triangles), "");
  EXPECT_TRUE(triangles.empty());
}

TEST(Polygon, IsSeenAlongTheAxisWithMostArea) {
  for (int axis = 0; axis < 3; ++axis) {
    Corners corners;
    for (const glm::dvec3& p : Corners{{0, 1, 0}, {3, 2, 0}, {2, 3, 0}, {1, 2, 0}, {0, 2, 0}})
      corners.push_back({p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]});
    Triangles triangles;
    EXPECT_EQ(cut(corners, triangles), "");
    EXPECT_EQ(triangles.size(), 3U);
  }
  Triangles triangles;
  EXPECT_EQ(cut({{1, 0, 0}, {1, 1, 1}, {1, 1, 0}, {1, 0, 1}}, triangles), crossing);
}

TEST(Polygon, AnyMagnitude) {
  for (const double scale : {1e308, 1e200, 1e-200, 1e-307}) {
    Corners corners{{0, 0.125, 0}, {0.375, 0.25, 0}, {0.25, 0.375, 0}, {0.125, 0.25, 0}, {0, 0.25, 0}};
    for (glm::dvec3& p : corners) p *= scale;
    Triangles triangles;
    EXPECT_EQ(cut(corners, triangles), "");
    EXPECT_EQ(triangles.size(), 3U);
  }
}

TEST(Polygon, OneBitDecides) {
  // The fourth corner is on the edge from the first to the third but for one bit, inside or outside.
  const double y = std::nextafter(0.3, 1.0);
  expect_exact({{0.1, 0.1, 0}, {0.9, 0.1, 0}, {0.9, 0.9, 0}, {0.3, y, 0}});
  expect_exact({{0.1, 0.1, 0}, {0.9, 0.1, 0}, {0.9, 0.9, 0}, {0.3, std::nextafter(0.3, 0.0), 0}});
  Triangles triangles;
  EXPECT_EQ(cut({{0.1, 0.1, 0}, {0.9, 0.9, 0}, {0.3, y, 0}, {0.3, 0.0, 0}}, triangles), crossing);
  EXPECT_EQ(cut({{0.1, 0.1, 0}, {0.9, 0.9, 0}, {0.3, 0.3, 0}, {0.3, 0.0, 0}}, triangles), "");
}

TEST(Polygon, SpiralAndRibbon) {
  Corners spiral;
  for (int i = 0; i < 5000; ++i) {
    const double a = 0.1 * i;
    spiral.emplace_back((1 + 0.05 * a) * std::cos(a), (1 + 0.05 * a) * std::sin(a), 0);
  }
  for (int i = 5000; i-- > 0;) {
    const double a = 0.1 * i;
    spiral.emplace_back((1.1 + 0.05 * a) * std::cos(a), (1.1 + 0.05 * a) * std::sin(a), 0);
  }
  EXPECT_EQ(expect_exact(spiral).size(), 9998U);
  Corners ribbon;
  for (int i = 0; i < 8000; ++i) ribbon.emplace_back(0.01 * i, std::sin(0.01 * i), 0);
  for (int i = 8000; i-- > 0;) ribbon.emplace_back(0.01 * i, std::sin(0.01 * i) + 1e-3, 0);
  EXPECT_EQ(expect_exact(ribbon).size(), 15998U);
}

TEST(Polygon, ThatCrossesItselfIsRefused) {
  for (const Corners& corners :
       {Corners{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}},                                   // a bow
        Corners{{0, 0, 0}, {3, 3, 0}, {3, 0, 0}, {0, 1, 0}},                                   // with area
        Corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}},             // twice around
        Corners{{0, 3, 0}, {2, -3, 0}, {-3, 1, 0}, {3, 1, 0}, {-2, -3, 0}},                    // a star
        Corners{{0, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 2, 0}, {1, 1, 0}, {0, 2, 0}, {2, 3, 0}},  // in a corner
        Corners{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 0}}}) {                     // by a spike
    Triangles triangles{{7, 8, 9}};
    EXPECT_EQ(cut(corners, triangles), crossing);
    EXPECT_EQ(triangles, (Triangles{{7, 8, 9}}));
  }
}

TEST(Polygon, WithTooManyEdgesOverOneCornerIsRefused) {
  std::mt19937 random(4);
  Corners corners;
  for (int i = 0; i < 2000; ++i) corners.emplace_back(random() % 100000, 0, 0);
  corners.emplace_back(1, 1, 0);
  Triangles triangles;
  EXPECT_EQ(cut(corners, triangles), "has a corner that more than 256 of its edges run through");
}

TEST(Polygon, OutOfItsPlaneIsRefused) {
  Triangles triangles;
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0.1}, {1, 1, 0}, {0, 1, 0.1}}, triangles), "");
  EXPECT_EQ(triangles.size(), 2U);
  EXPECT_EQ(cut({{-5, 0, 5}, {5, 0, 5}, {5, 0, -5}, {-5, 0, -5}, {0, 5, -5}}, triangles),
            "does not lie in a plane: corner 5 is 3.79 off it; allowed is a quarter of the extent, 3.75");
  EXPECT_EQ(triangles.size(), 2U);
}

}  // namespace
}  // namespace hitpipe::ref::polygon_test
