#include "rays/files/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <fmt/format.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

#include "rays/files/ears.hpp"
#include "rays/files/winding.hpp"
#include "rays/mesh/orientation.hpp"

namespace hitpipe::ref {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

double largest(const glm::dvec3& v) {
  return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The corners as orientation() takes them: all are multiplied by one power of 2 if they are very large or
/// very small. Returns its exponent.
int scaled(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> polygon,
           std::vector<glm::dvec3>& corners) {
  corners.reserve(polygon.size());
  double most = 0.0;
  for (const std::uint32_t place : polygon) {
    corners.push_back(positions[place]);
    most = std::max(most, largest(corners.back()));
  }
  const int exponent = most == 0.0 || (most >= 0x1p-100 && most <= 0x1p99) ? 0 : -std::ilogb(most);
  for (glm::dvec3& corner : corners) {
    for (int axis = 0; axis < 3; ++axis) {
      if (exponent != 0) corner[axis] = std::ldexp(corner[axis], exponent);
      if (std::abs(corner[axis]) < 0x1p-480) corner[axis] = 0.0;
    }
  }
  return exponent;
}

/// Twice the area along each axis, with rounding.
glm::dvec3 newell(const std::vector<glm::dvec3>& corners) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += glm::cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

/// What is wrong if a corner is too far from the plane; empty if none is.
std::string off_plane(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal, int exponent) {
  glm::dvec3 low = corners[0];
  glm::dvec3 high = low;
  glm::dvec3 mean(0.0);
  for (const glm::dvec3& p : corners) {
    low = glm::min(low, p);
    high = glm::max(high, p);
    mean += (p - corners[0]) / static_cast<double>(corners.size());
  }
  mean += corners[0];
  const double extent = glm::length(high - low);
  // A normal below its rounding has no direction: the corners are nearly on a line.
  if (glm::length(normal) <= 0x1p-40 * extent * extent) return {};
  const glm::dvec3 unit = glm::normalize(normal);
  double most = 0.0;
  std::size_t farthest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double off = std::abs(glm::dot(unit, corners[i] - mean));
    if (off <= most) continue;
    most = off;
    farthest = i;
  }
  if (most <= most_off_plane * extent) return {};
  return fmt::format(
      "does not lie in a plane: corner {} is {:.3g} off it; allowed is a quarter of the extent, {:.3g}",
      farthest + 1, std::ldexp(most, -exponent), std::ldexp(most_off_plane * extent, -exponent));
}

/// Strictly: all corners turn to one side, once around. Then any corner sees all others.
bool is_convex(std::span<const glm::dvec2> corners) {
  const std::size_t n = corners.size();
  const auto goes_right = [](const glm::dvec2& p, const glm::dvec2& q) {
    return p.x < q.x || (p.x == q.x && p.y < q.y);
  };
  const int turn = orientation(corners[0], corners[1], corners[2]);
  if (turn == 0) return false;
  int changes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2& a = corners[i];
    const glm::dvec2& b = corners[i + 1 < n ? i + 1 : i + 1 - n];
    const glm::dvec2& c = corners[i + 2 < n ? i + 2 : i + 2 - n];
    if (orientation(a, b, c) != turn) return false;
    changes += static_cast<int>(goes_right(a, b) != goes_right(b, c));
  }
  return changes == 2;
}

bool is_flat(std::span<const glm::dvec2> corners) {
  const auto other =
      std::find_if(corners.begin(), corners.end(), [&](const glm::dvec2& p) { return p != corners[0]; });
  return other == corners.end() || std::all_of(other, corners.end(), [&](const glm::dvec2& p) {
           return orientation(corners[0], *other, p) == 0;
         });
}

/// The corners along the axis that the normal is nearest to. If all lie on a line there, along another.
std::vector<glm::dvec2> project(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
  std::vector<glm::dvec2> seen;
  std::array<int, 3> axes{2, 1, 0};
  std::stable_sort(axes.begin(), axes.end(),
                   [&](int a, int b) { return std::abs(normal[a]) > std::abs(normal[b]); });
  for (const int axis : axes) {
    seen.clear();
    for (const glm::dvec3& p : corners) seen.emplace_back(p[(axis + 1) % 3], p[(axis + 2) % 3]);
    if (!is_flat(seen)) break;
  }
  return seen;
}

/// Adds triangles of places in `seen`. Returns what is wrong; empty if nothing is.
std::string cut(std::vector<glm::dvec2> seen, Triangles& triangles) {
  if (is_convex(seen) || is_flat(seen)) {
    for (std::uint32_t i = 2; i < seen.size(); ++i) triangles.push_back({0, i - 1, i});
    return {};
  }
  const Winding found = winding(seen);
  if (found == Winding::crowded)
    return fmt::format("has a corner that more than {} of its edges run through", most_through_corner);
  if (found == Winding::right)
    for (glm::dvec2& p : seen) std::swap(p.x, p.y);  // a mirror image
  return found != Winding::crossing && cut_ears(seen, triangles) ? ""
                                                                 : "crosses itself or covers an area twice";
}

}  // namespace

std::string triangulate(std::span<const glm::dvec3> positions, std::span<const std::uint32_t> polygon,
                        Triangles& triangles) {
  if (polygon.size() < 3) return {};
  if (polygon.size() == 3) {
    triangles.push_back({polygon[0], polygon[1], polygon[2]});
    return {};
  }
  const std::size_t start = triangles.size();
  std::vector<glm::dvec3> corners;
  const int exponent = scaled(positions, polygon, corners);
  const glm::dvec3 normal = newell(corners);
  std::string fault = cut(project(corners, normal), triangles);
  if (fault.empty()) fault = off_plane(corners, normal, exponent);
  if (!fault.empty()) triangles.resize(start);
  for (std::size_t t = start; t < triangles.size(); ++t)
    for (std::uint32_t& corner : triangles[t]) corner = polygon[corner];
  return fault;
}

}  // namespace hitpipe::ref
