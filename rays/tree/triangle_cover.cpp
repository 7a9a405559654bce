// A piece of the triangle that no box holds is cut by a face of a box, and both halves are tested with the
// boxes that they meet. The middle one of the faces that cut the piece is taken, so the depth is the
// logarithm of their number.
#include "rays/tree/triangle_cover.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

namespace hitpipe::ref {

namespace {

using Box = BasicAabb<double>;
using Polygon = std::vector<glm::dvec3>;

Box bounds(const Polygon& polygon) {
  Box box;
  for (const glm::dvec3& p : polygon) box.grow(p);
  return box;
}

bool holds(const Box& outer, const Box& inner) {
  for (int axis = 0; axis < 3; ++axis)
    if (outer.min[axis] > inner.min[axis] || outer.max[axis] < inner.max[axis]) return false;
  return true;
}

bool meets(const Box& a, const Box& b) {
  for (int axis = 0; axis < 3; ++axis)
    if (a.min[axis] > b.max[axis] || a.max[axis] < b.min[axis]) return false;
  return true;
}

/// The parts of a polygon below and above a plane. Both have the new corners.
std::array<Polygon, 2> cut(const Polygon& polygon, int axis, double plane) {
  std::array<Polygon, 2> parts;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& p = polygon[i];
    const glm::dvec3& q = polygon[(i + 1) % polygon.size()];
    if (p[axis] <= plane) parts[0].push_back(p);
    if (p[axis] >= plane) parts[1].push_back(p);
    if ((p[axis] < plane && q[axis] > plane) || (p[axis] > plane && q[axis] < plane)) {
      glm::dvec3 between = p + (q - p) * ((plane - p[axis]) / (q[axis] - p[axis]));
      between = glm::clamp(between, glm::min(p, q), glm::max(p, q));
      between[axis] = plane;
      for (Polygon& part : parts) part.push_back(between);
    }
  }
  return parts;
}

/// The planes of boxes that lie strictly within a piece, along the axis that has most of them.
struct Faces {
  int axis = 0;
  std::vector<double> planes;
};

Faces faces_within(const Box& piece, const std::vector<Box>& boxes) {
  Faces most;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> planes;
    for (const Box& box : boxes) {
      for (const double plane : {box.min[axis], box.max[axis]})
        if (plane > piece.min[axis] && plane < piece.max[axis]) planes.push_back(plane);
    }
    if (planes.size() > most.planes.size()) most = {axis, std::move(planes)};
  }
  return most;
}

bool covered(const Polygon& piece, const std::vector<Box>& candidates) {
  const Box around = bounds(piece);
  std::vector<Box> boxes;
  for (const Box& box : candidates) {
    if (holds(box, around)) return true;
    if (meets(box, around)) boxes.push_back(box);
  }
  Faces faces = faces_within(around, boxes);
  if (faces.planes.empty()) return false;
  const auto middle = faces.planes.begin() + static_cast<std::ptrdiff_t>(faces.planes.size() / 2);
  std::nth_element(faces.planes.begin(), middle, faces.planes.end());
  const std::array<Polygon, 2> parts = cut(piece, faces.axis, *middle);
  return covered(parts[0], boxes) && covered(parts[1], boxes);
}

}  // namespace

bool cover(std::span<const Aabb> boxes, const Mesh::Corners& triangle, double slack) {
  std::vector<Box> grown;
  grown.reserve(boxes.size());
  for (const Aabb& box : boxes) grown.push_back({glm::dvec3(box.min) - slack, glm::dvec3(box.max) + slack});
  return covered({triangle.a, triangle.b, triangle.c}, grown);
}

}  // namespace hitpipe::ref
