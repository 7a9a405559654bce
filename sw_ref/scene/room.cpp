#include "sw_ref/scene/room.hpp"

#include <array>

#include <glm/geometric.hpp>

namespace hitpipe::ref {
namespace {

/// The side of the box that the triangle lies in, 0..5 (axis, then min or max), or -1. Bounds are those of
/// the binary32 vertices, so equality is exact.
int side_of(const Mesh::Corners& t, const Bounds& walls) {
  for (int axis = 0; axis < 3; ++axis) {
    if (t.a[axis] != t.b[axis] || t.a[axis] != t.c[axis]) continue;
    if (double{t.a[axis]} == walls.min[axis]) return 2 * axis;
    if (double{t.a[axis]} == walls.max[axis]) return 2 * axis + 1;
  }
  return -1;
}

}  // namespace

std::optional<Bounds> room_contents(const Mesh& mesh, const Bounds& walls) {
  constexpr double covered = 0.99;
  const glm::dvec3 size = walls.max - walls.min;
  std::array<double, 6> area{};
  std::optional<Bounds> contents;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const Mesh::Corners t = mesh.corners(i);
    if (const int side = side_of(t, walls); side >= 0) {
      const glm::dvec3 a = t.a;
      area[static_cast<std::size_t>(side)] +=
          0.5 * glm::length(glm::cross(glm::dvec3(t.b) - a, glm::dvec3(t.c) - a));
      continue;
    }
    if (!contents) contents = Bounds{t.a, t.a};
    for (const glm::vec3& corner : {t.a, t.b, t.c}) contents->grow(corner);
  }
  for (int side = 0; side < 6; ++side) {
    const int axis = side / 2;
    const double whole = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    if (!(area[static_cast<std::size_t>(side)] >= covered * whole) || whole == 0.0) return std::nullopt;
  }
  return contents;
}

}  // namespace hitpipe::ref
