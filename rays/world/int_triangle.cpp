#include "rays/world/int_triangle.hpp"

#include <algorithm>
#include <cmath>

namespace hitpipe::ref {

namespace {

using Vector = std::array<std::int64_t, 3>;

/// The triangle's plane from the first corner, and the ray's origin seen from there.
struct Sides {
  Vector first, second;  ///< in units of corners
  Vector from_origin;    ///< in units of the origin's grid
};

Sides sides_of(const IntRay& ray, const IntTriangle& triangle, int finer) {
  Sides sides{};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t a = triangle.corners[0][i];
    sides.first[i] = triangle.corners[1][i] - a;
    sides.second[i] = triangle.corners[2][i] - a;
    sides.from_origin[i] = (a << finer) - ray.origin[i];
  }
  return sides;
}

/// Certain that the line passes outside an edge. All rows are exact, so each of the six terms of a
/// determinant has at most 5 roundings: an error of 30 units of roundoff. `rest` has three determinants and
/// two sums: 128 units cover them.
bool is_outside(const IntRay& ray, const Sides& sides, int finer) {
  constexpr double bound = 0x1p-46;
  using Row = std::array<double, 3>;
  const auto row = [](const Vector& v) {
    return Row{static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
  };
  const auto size = [](const Row& v) { return std::max({std::abs(v[0]), std::abs(v[1]), std::abs(v[2])}); };
  const auto cross = [](const Row& p, const Row& q) {
    return Row{p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
  };
  const auto dot = [](const Row& p, const Row& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
  const Row direction = row(ray.direction);
  const Row first = row(sides.first);
  const Row second = row(sides.second);
  const Row corner = row(sides.from_origin);
  const Row p = cross(direction, second);
  const double scale = std::ldexp(1.0, finer);
  const double det = scale * dot(first, p);
  const double u = -dot(corner, p);
  const double v = -dot(direction, cross(corner, first));
  const double rest = det - u - v;
  const double unit = bound * size(direction);
  const double error = unit * std::max(size(first), size(second)) *
                       (size(corner) + scale * std::max(size(first), size(second)));
  const double lowest = std::min({u, v, rest});
  const double highest = std::max({u, v, rest});
  return lowest < -error && highest > error;
}

/// The definition: corners seen from the ray, moved along the direction onto the plane of the other two axes.
std::optional<IntCrossing> exact_crossing(const IntRay& ray, const IntTriangle& triangle,
                                          const hls::WorldBits& bits) {
  const auto m = static_cast<std::size_t>(ray.major);
  const std::size_t a = (m + 1) % 3;
  const std::size_t b = (m + 2) % 3;
  std::array<Int128, 3> depth, right, up;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto seen = [&](std::size_t axis) -> Int128 {
      const std::int64_t fine = (std::int64_t{triangle.corners[i][axis]} << bits.finer) - ray.origin[axis];
      return ray.direction[axis] < 0 ? -fine : fine;
    };
    const auto slope = [&](std::size_t axis) -> Int128 { return std::abs(ray.direction[axis]); };
    depth[i] = seen(m);
    right[i] = (seen(a) << bits.slope) - slope(a) * depth[i];
    up[i] = (seen(b) << bits.slope) - slope(b) * depth[i];
  }
  IntCrossing found;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::size_t k = (i + 2) % 3;
    found.e[i] = (right[j] * up[k] - right[k] * up[j]) >> bits.slope;
    found.det += found.e[i];
  }
  if (found.det == 0) return std::nullopt;
  if (found.det < 0) {
    for (Int128& each : found.e) each = -each;
    found.det = -found.det;
  }
  if (*std::min_element(found.e.begin(), found.e.end()) < 0) return std::nullopt;
  const Int128 distance = found.e[0] * depth[0] + found.e[1] * depth[1] + found.e[2] * depth[2];
  if (distance < 0) return std::nullopt;
  found.t = static_cast<std::int64_t>((distance << bits.fraction) / found.det);
  if (found.t > ray.length) return std::nullopt;
  return found;
}

}  // namespace

std::optional<IntCrossing> int_crossing(const IntRay& ray, const IntTriangle& triangle,
                                        const hls::WorldBits& bits) {
  if (is_outside(ray, sides_of(ray, triangle, bits.finer), bits.finer)) return std::nullopt;
  return exact_crossing(ray, triangle, bits);
}

}  // namespace hitpipe::ref
