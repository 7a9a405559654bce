// Closed surfaces of the integer world as an adversary would aim at them. A ray that begins inside always
// leaves, and a line that meets no edge passes through the surface an even number of times.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <optional>
#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "rays/world/int_triangle.hpp"
#include "tests/rays/world/cases.hpp"

namespace hitpipe::ref::closed_mesh_test {
namespace {

using hls::WorldBits;
using world_cases::Draw;

using Point = std::array<std::int64_t, 3>;
using Real = std::array<double, 3>;

/// Points are in units of the origin's grid.
struct Closed {
  std::vector<IntTriangle> faces;
  Point inside{};                                ///< strictly
  std::function<bool(const Point&)> is_outside;  ///< strictly; false where it does not know
};

IntTriangle::Corner rounded(const Real& x) {
  IntTriangle::Corner made{};
  for (std::size_t k = 0; k < 3; ++k) made[k] = static_cast<std::int32_t>(std::lround(x[k]));
  return made;
}

Point on_fine_grid(const IntTriangle::Corner& corner, const WorldBits& bits) {
  Point made{};
  for (std::size_t k = 0; k < 3; ++k) made[k] = std::int64_t{corner[k]} << bits.finer;
  return made;
}

/// Beyond a face of the box of all corners.
std::function<bool(const Point&)> beyond_the_box(const std::vector<IntTriangle>& faces,
                                                 const WorldBits& bits) {
  Point low = on_fine_grid(faces[0].corners[0], bits), high = low;
  for (const IntTriangle& face : faces)
    for (const auto& corner : face.corners)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::int64_t x = std::int64_t{corner[k]} << bits.finer;
        low[k] = std::min(low[k], x);
        high[k] = std::max(high[k], x);
      }
  return [low, high](const Point& p) {
    for (std::size_t k = 0; k < 3; ++k)
      if (p[k] < low[k] || p[k] > high[k]) return true;
    return false;
  };
}

/// Its corners are equal wherever faces share them, because equal numbers are rounded.
void add_part_of_sphere(const std::array<Real, 3>& corners, int cuts, const Real& centre, double radius,
                        std::vector<IntTriangle>& faces) {
  if (cuts == 0) {
    IntTriangle face;
    for (std::size_t i = 0; i < 3; ++i) {
      const double length = std::hypot(corners[i][0], corners[i][1], corners[i][2]);
      Real place{};
      for (std::size_t k = 0; k < 3; ++k) place[k] = centre[k] + radius * corners[i][k] / length;
      face.corners[i] = rounded(place);
    }
    faces.push_back(face);
    return;
  }
  const auto between = [&](std::size_t i, std::size_t j) {
    Real middle{};
    for (std::size_t k = 0; k < 3; ++k) middle[k] = (corners[i][k] + corners[j][k]) / 2;
    return middle;
  };
  const Real a = between(1, 2), b = between(2, 0), c = between(0, 1);
  for (const std::array<Real, 3>& part : {std::array{corners[0], c, b}, std::array{c, corners[1], a},
                                          std::array{b, a, corners[2]}, std::array{a, b, c}})
    add_part_of_sphere(part, cuts - 1, centre, radius, faces);
}

/// A centre for what reaches `radius` units from it, and stays inside the cube.
Real drawn_centre(Draw& draw, const WorldBits& bits, std::int64_t radius) {
  const std::int64_t most = bits.largest_corner() - radius;
  Real centre{};
  for (double& x : centre) x = static_cast<double>(draw.integer(-most, most));
  return centre;
}

/// An octahedron, of which every face is cut into four `cuts` times.
Closed sphere(Draw& draw, const WorldBits& bits, int cuts) {
  const std::int64_t radius = draw.integer(1, std::max<std::int64_t>(1, bits.largest_corner() / 2));
  Closed made;
  const Real centre = drawn_centre(draw, bits, radius);
  for (unsigned face = 0; face < 8; ++face) {
    std::array<Real, 3> corners{};
    for (std::size_t k = 0; k < 3; ++k) corners[k][k] = (face >> k & 1U) != 0 ? -1.0 : 1.0;
    add_part_of_sphere(corners, cuts, centre, static_cast<double>(radius), made.faces);
  }
  made.inside = on_fine_grid(rounded(centre), bits);
  made.is_outside = beyond_the_box(made.faces, bits);
  return made;
}

/// Of `rings` polygons with `sides` corners around the axis z. Its tube is thick enough that rounding leaves
/// its middle inside; nothing where the grid is too coarse for that.
std::optional<Closed> torus(Draw& draw, const WorldBits& bits) {
  constexpr int rings = 9, sides = 7;
  if (bits.largest_corner() < 60) return std::nullopt;
  const std::int64_t reach = draw.integer(24, bits.largest_corner() / 2);
  const auto tube = static_cast<double>(reach) / 3;
  const Real centre = drawn_centre(draw, bits, reach);
  const auto place = [&](int ring, int side, double from_middle) {
    const double around = 2 * std::numbers::pi * (ring % rings) / rings;
    const double across = 2 * std::numbers::pi * (side % sides) / sides;
    const double out = 2 * tube + from_middle * std::cos(across);
    return rounded({centre[0] + out * std::cos(around), centre[1] + out * std::sin(around),
                    centre[2] + from_middle * std::sin(across)});
  };
  Closed made;
  for (int ring = 0; ring < rings; ++ring)
    for (int side = 0; side < sides; ++side) {
      const auto a = place(ring, side, tube), b = place(ring + 1, side, tube);
      const auto c = place(ring + 1, side + 1, tube), d = place(ring, side + 1, tube);
      made.faces.push_back({{a, b, c}});
      made.faces.push_back({{a, c, d}});
    }
  made.inside = on_fine_grid(place(static_cast<int>(draw.integer(0, rings - 1)), 0, 0), bits);
  made.is_outside = beyond_the_box(made.faces, bits);
  return made;
}

/// Six times the volume of the three corners and a point.
Int128 volume(const IntTriangle& face, const Point& p, const WorldBits& bits) {
  std::array<std::array<Int128, 3>, 3> d{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k) d[i][k] = on_fine_grid(face.corners[i], bits)[k] - p[k];
  return d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
         d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
         d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
}

/// Nothing where the point is not strictly inside.
std::optional<Closed> tetrahedron(const std::array<IntTriangle::Corner, 4>& c, const Point& inside,
                                  const WorldBits& bits) {
  Closed made;
  made.faces = {{{c[0], c[1], c[2]}}, {{c[0], c[2], c[3]}}, {{c[0], c[3], c[1]}}, {{c[1], c[3], c[2]}}};
  made.inside = inside;
  const auto sides = [faces = made.faces, bits](const Point& p) {
    std::array<int, 3> count{};  // below, in and above the planes
    for (const IntTriangle& face : faces) {
      const Int128 side = volume(face, p, bits);
      ++count[side < 0 ? 0 : side == 0 ? 1 : 2];
    }
    return count;
  };
  const auto count = sides(inside);
  if (count[0] != 4 && count[2] != 4) return std::nullopt;
  const std::size_t outward = count[0] == 4 ? 2 : 0;
  made.is_outside = [sides, outward](const Point& p) { return sides(p)[outward] > 0; };
  return made;
}

/// Four corners in two parallel planes that are two units apart, at opposite ends of long edges.
std::optional<Closed> sliver(Draw& draw, const WorldBits& bits) {
  const std::int64_t reach = draw.integer(1, bits.largest_corner());
  const Real middle = drawn_centre(draw, bits, reach);
  const auto thin = static_cast<std::size_t>(draw.integer(0, 2));
  std::array<IntTriangle::Corner, 4> corners{};
  for (std::size_t i = 0; i < 4; ++i) {
    Real place = middle;
    place[(thin + 1) % 3] += static_cast<double>((i & 1U) != 0 ? reach : -reach);
    place[(thin + 2) % 3] += static_cast<double>((i & 2U) != 0 ? reach : -reach);
    place[thin] += i == 0 || i == 3 ? 1.0 : -1.0;
    corners[i] = rounded(place);
  }
  return tetrahedron(corners, on_fine_grid(rounded(middle), bits), bits);
}

/// Half of the coordinates of its corners are at an end of the cube.
std::optional<Closed> wide_tetrahedron(Draw& draw, const WorldBits& bits) {
  const std::int64_t most = bits.largest_corner();
  std::array<IntTriangle::Corner, 4> corners{};
  Point middle{};
  for (auto& corner : corners)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int64_t end = draw.one_in(2) ? most : -most;
      corner[k] = static_cast<std::int32_t>(draw.one_in(2) ? end : draw.integer(-most, most));
      middle[k] += std::int64_t{corner[k]} << bits.finer;
    }
  for (std::int64_t& x : middle) x /= 4;
  return tetrahedron(corners, middle, bits);
}

struct Shape {
  const char* name;
  std::optional<Closed> (*make)(Draw& draw, const WorldBits& bits);
  int tests;
};

void PrintTo(const Shape& shape, std::ostream* out) {
  *out << shape.name;
}

struct Met {
  int faces = 0;
  bool only_inside_of_faces = true;
};

Met met(const IntRay& ray, const Closed& closed, const WorldBits& bits) {
  Met sum;
  for (const IntTriangle& face : closed.faces) {
    const auto crossing = int_crossing(ray, face, bits);
    if (!crossing) continue;
    ++sum.faces;
    if (*std::min_element(crossing->e.begin(), crossing->e.end()) == 0) sum.only_inside_of_faces = false;
  }
  return sum;
}

IntRay turned(IntRay ray) {
  for (std::size_t k = 0; k < 3; ++k) {
    ray.direction[k] = -ray.direction[k];
    ray.negative[k] = !ray.negative[k];
  }
  return ray;
}

class ClosedMesh : public testing::TestWithParam<Shape> {};

TEST_P(ClosedMesh, IsLeftFromInsideAndCrossedEvenly) {
  Draw draw(39003);
  int from_inside = 0, at_an_edge = 0, odd = 0, even = 0, crossed = 0;
  for (int i = 0; i < GetParam().tests; ++i) {
    const WorldBits bits = draw.bits();
    const std::optional<Closed> closed = GetParam().make(draw, bits);
    if (!closed) continue;
    const auto aimed_from = [&](const Point& origin) {
      const auto face =
          static_cast<std::size_t>(draw.integer(0, static_cast<std::int64_t>(closed->faces.size()) - 1));
      IntRay ray = draw.ray(bits, origin, closed->faces[face]);
      ray.length = bits.largest_distance();
      return ray;
    };
    const IntRay out = aimed_from(closed->inside);
    for (const IntRay& ray : {out, turned(out)}) {
      const Met leaves = met(ray, *closed, bits);
      ASSERT_GE(leaves.faces, 1) << "case " << i;
      ++from_inside;
      if (leaves.only_inside_of_faces) {
        ASSERT_EQ(leaves.faces % 2, 1) << "case " << i;
        ++odd;
      } else {
        ++at_an_edge;
      }
    }
    const Point far = draw.origin(bits);
    if (!closed->is_outside(far)) continue;
    const IntRay past = aimed_from(far);
    for (const IntRay& ray : {past, turned(past)}) {
      const Met through = met(ray, *closed, bits);
      if (!through.only_inside_of_faces) continue;
      ASSERT_EQ(through.faces % 2, 0) << "case " << i;
      ++even;
      crossed += through.faces > 0 ? 1 : 0;
    }
  }
  const int tests = GetParam().tests;
  EXPECT_GT(from_inside, tests / 4);
  EXPECT_GT(at_an_edge, tests / 100);
  EXPECT_GT(odd, tests / 4);
  EXPECT_GT(even, tests / 4);
  EXPECT_GT(crossed, tests / 20);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, ClosedMesh,
    testing::Values(
        Shape{"octahedron",
              [](Draw& d, const WorldBits& b) -> std::optional<Closed> { return sphere(d, b, 0); }, 40'000},
        Shape{"sphere", [](Draw& d, const WorldBits& b) -> std::optional<Closed> { return sphere(d, b, 3); },
              5'000},
        Shape{"torus", torus, 20'000}, Shape{"sliver", sliver, 40'000},
        Shape{"wide_tetrahedron", wide_tetrahedron, 40'000}),
    [](const auto& one) { return one.param.name; });

}  // namespace
}  // namespace hitpipe::ref::closed_mesh_test
