// Random rays and triangles of the integer world, many of them at an edge or a corner, and the definition of
// a hit in rational numbers by another road than the code's: first the plane, then the weights of the
// corners.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>

#include "rays/world/int_ray.hpp"
#include "rays/world/int_triangle.hpp"
#include "tests/rays/exact/rational.hpp"

namespace hitpipe::ref::world_cases {

using hls::WorldBits;
using oracle::Rational;

struct Case {
  WorldBits bits;
  IntRay ray;
  IntTriangle triangle;
};

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : rng_(seed) {}

  std::int64_t integer(std::int64_t low, std::int64_t high) {
    return std::uniform_int_distribution<std::int64_t>(low, high)(rng_);
  }
  bool one_in(int n) { return integer(1, n) == 1; }

  WorldBits bits() {
    constexpr std::array coords{4, 6, 8, 12, 16, 20, 22, 24};
    constexpr std::array slopes{2, 4, 8, 12, 16, 20, 24, 32};
    constexpr std::array fractions{0, 2, 8};
    return {pick(coords), static_cast<int>(integer(0, 3)), pick(slopes), pick(fractions)};
  }

  IntTriangle triangle(const WorldBits& bits) {
    const std::int64_t most = bits.largest_corner();
    const std::array<std::int64_t, 5> sizes{1, 2, 5, most / 2 + 1, 2 * most};
    const std::int64_t size = pick(sizes);
    IntTriangle made;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t first = one_in(8) ? (one_in(2) ? most : -most) : integer(-most, most);
      for (auto& corner : made.corners)
        corner[axis] = static_cast<std::int32_t>(std::clamp(first + integer(-size, size), -most, most));
    }
    return made;
  }

  std::array<std::int64_t, 3> origin(const WorldBits& bits) {
    std::array<std::int64_t, 3> made{};
    for (auto& x : made) {
      x = integer(-bits.largest_point(), bits.largest_point());
      if (one_in(6)) x &= ~((std::int64_t{1} << bits.finer) - 1);
      if (one_in(20)) x = one_in(2) ? bits.largest_point() : -bits.largest_point();
    }
    return made;
  }

  IntRay ray(const WorldBits& bits, const IntTriangle& triangle) {
    const std::array<std::int64_t, 3> from = origin(bits);
    return ray(bits, from, triangle);
  }

  /// Aimed at a corner, at a point of an edge or of the inside, or anywhere. Its direction is what the door
  /// makes of the way there.
  IntRay ray(const WorldBits& bits, const std::array<std::int64_t, 3>& from, const IntTriangle& triangle) {
    constexpr std::array<std::array<std::int64_t, 3>, 5> weights{
        {{1, 0, 0}, {1, 1, 0}, {0, 1, 3}, {1, 1, 1}, {3, 2, 1}}};
    std::array<std::int64_t, 3> way{};
    const auto& w = pick(weights);
    const bool aimed = !one_in(4);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::int64_t sum = 0;
      for (std::size_t i = 0; i < 3; ++i) sum += w[i] * triangle.corners[i][axis];
      way[axis] = aimed ? (sum << bits.finer) - (w[0] + w[1] + w[2]) * from[axis] : integer(-1000, 1000);
    }
    if (one_in(5)) way[static_cast<std::size_t>(integer(0, 2))] = 0;
    if (one_in(5)) way[static_cast<std::size_t>(integer(0, 2))] >>= integer(0, 20);
    if (way == std::array<std::int64_t, 3>{}) way[static_cast<std::size_t>(integer(0, 2))] = 1;
    IntRay made = along(bits, from, way);
    made.length = one_in(3) ? integer(0, bits.largest_distance()) : bits.largest_distance();
    return made;
  }

  /// What the door makes of this way, which is not 0: a ray without an end.
  static IntRay along(const WorldBits& bits, const std::array<std::int64_t, 3>& from,
                      const std::array<std::int64_t, 3>& way) {
    IntRay made;
    made.origin = from;
    for (std::size_t axis = 1; axis < 3; ++axis)
      if (std::abs(way[axis]) > std::abs(way[static_cast<std::size_t>(made.major)]))
        made.major = static_cast<int>(axis);
    const std::int64_t longest = std::abs(way[static_cast<std::size_t>(made.major)]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      made.negative[axis] = way[axis] < 0;
      const auto size = static_cast<std::int64_t>(
          (2 * (static_cast<Int128>(std::abs(way[axis])) << bits.slope) + longest) / (2 * longest));
      made.direction[axis] = way[axis] < 0 ? -size : size;
    }
    made.length = bits.largest_distance();
    return made;
  }

  Case next() {
    Case c{bits(), {}, {}};
    c.triangle = triangle(c.bits);
    c.ray = ray(c.bits, c.triangle);
    return c;
  }

  template <class Values>
  const typename Values::value_type& pick(const Values& values) {
    return values[static_cast<std::size_t>(integer(0, static_cast<std::int64_t>(values.size()) - 1))];
  }

 private:
  std::mt19937_64 rng_;
};

/// The exact distance along the major axis in units of the origin's grid, and the weights of the corners.
struct Truth {
  Rational distance;
  std::array<Rational, 3> weights;
};

/// Nothing: the line, from its origin on, does not meet the closed triangle in one point.
inline std::optional<Truth> truth(const Case& c) {
  using Vector = std::array<Rational, 3>;
  const auto minus = [](const Vector& p, const Vector& q) {
    return Vector{p[0] - q[0], p[1] - q[1], p[2] - q[2]};
  };
  const auto dot = [](const Vector& p, const Vector& q) -> Rational {
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  };
  const auto cross = [](const Vector& p, const Vector& q) {
    return Vector{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  };
  Vector origin, direction;
  std::array<Vector, 3> corners;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    origin[axis] = c.ray.origin[axis];
    direction[axis] = Rational(c.ray.direction[axis]) / (std::int64_t{1} << c.bits.slope);
    for (std::size_t i = 0; i < 3; ++i)
      corners[i][axis] = std::int64_t{c.triangle.corners[i][axis]} << c.bits.finer;
  }
  const Vector first = minus(corners[1], corners[0]);
  const Vector second = minus(corners[2], corners[0]);
  const Vector normal = cross(first, second);
  const Rational steepness = dot(direction, normal);
  if (steepness == 0) return std::nullopt;
  Truth found;
  found.distance = dot(minus(corners[0], origin), normal) / steepness;
  Vector place;
  for (std::size_t axis = 0; axis < 3; ++axis) place[axis] = origin[axis] + found.distance * direction[axis];
  const Vector within = minus(place, corners[0]);
  const Rational aa = dot(first, first), ab = dot(first, second), bb = dot(second, second);
  const Rational wa = dot(within, first), wb = dot(within, second);
  const Rational area = aa * bb - ab * ab;
  found.weights[1] = (bb * wa - ab * wb) / area;
  found.weights[2] = (aa * wb - ab * wa) / area;
  found.weights[0] = 1 - found.weights[1] - found.weights[2];
  if (found.distance < 0 || *std::min_element(found.weights.begin(), found.weights.end()) < 0)
    return std::nullopt;
  return found;
}

}  // namespace hitpipe::ref::world_cases
