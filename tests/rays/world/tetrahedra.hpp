// Closed meshes of the integer world that are hard to cross an even number of times: boundaries of tetrahedra whose
// corners are in few places, so that corners, edges and planes coincide, and lines through them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "rays/world/int_mesh.hpp"
#include "tests/rays/world/cases.hpp"

namespace hitpipe::ref::tetrahedra {

using hls::WorldBits;
using world_cases::Draw;
using Corner = IntTriangle::Corner;
using Tetrahedron = std::array<Corner, 4>;
using Point = std::array<std::int64_t, 3>;

/// They may overlap and be flat: what is in an odd number of them is inside.
struct Solid {
  WorldBits bits;
  std::vector<Tetrahedron> parts;
};

/// The face without corner i, whose orientation goes with the others' of the tetrahedron.
inline IntTriangle face_of(const Tetrahedron& part, std::size_t i) {
  constexpr std::array<std::array<std::size_t, 3>, 4> corners{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
  return {{part[corners[i][0]], part[corners[i][1]], part[corners[i][2]]}};
}

/// The same triangle with its corners in order, and 1 or -1: an even or an odd exchange of corners.
inline std::pair<IntTriangle, int> ordered(IntTriangle triangle) {
  int sign = 1;
  for (const std::size_t i : {0U, 1U, 0U})
    if (triangle.corners[i + 1] < triangle.corners[i]) {
      std::swap(triangle.corners[i], triangle.corners[i + 1]);
      sign = -sign;
    }
  return {triangle, sign};
}

inline std::map<std::array<Corner, 3>, int> faces_of(const Solid& solid, bool oriented) {
  std::map<std::array<Corner, 3>, int> sum;
  for (const Tetrahedron& part : solid.parts)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [face, sign] = ordered(face_of(part, i));
      sum[face.corners] += oriented ? sign : 1;
    }
  return sum;
}

/// Triangles of an odd number of tetrahedra: each edge has an even number of them. They have no orientation.
inline std::vector<IntTriangle> boundary(const Solid& solid) {
  std::vector<IntTriangle> mesh;
  for (const auto& [corners, count] : faces_of(solid, false))
    if (count % 2 != 0) mesh.push_back({corners});
  return mesh;
}

/// Each edge is passed as often in either direction. A triangle can be there more than once.
inline std::vector<IntTriangle> oriented_boundary(const Solid& solid) {
  std::vector<IntTriangle> mesh;
  for (const auto& [corners, count] : faces_of(solid, true))
    for (int i = 0; i < std::abs(count); ++i)
      mesh.push_back(count > 0 ? IntTriangle{corners} : IntTriangle{{corners[0], corners[2], corners[1]}});
  return mesh;
}

/// Its grid gives the triangles again. They keep their order, without those that have no area.
inline IntMesh mesh_of(const std::vector<IntTriangle>& triangles, const WorldBits& bits) {
  Mesh mesh;
  const auto most = static_cast<float>(bits.largest_corner());
  for (const IntTriangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& corner : triangle.corners)
      mesh.vertices.emplace_back(static_cast<float>(corner[0]) / most, static_cast<float>(corner[1]) / most,
                                 static_cast<float>(corner[2]) / most);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return int_mesh(mesh, bits.coord);
}

/// Is the point, in units of the origin's grid, in an odd number of the tetrahedra? Nothing if it is on a face.
inline std::optional<bool> inside(const Solid& solid, const Point& point) {
  bool odd = false;
  for (const Tetrahedron& part : solid.parts) {
    // Six times the volume that the point has with each face.
    std::array<Int128, 4> volume{};
    Int128 whole = 0;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::array<Int128, 3>, 3> d{};
      const IntTriangle face = face_of(part, i);
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t axis = 0; axis < 3; ++axis)
          d[k][axis] = (std::int64_t{face.corners[k][axis]} << solid.bits.finer) - point[axis];
      volume[i] = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                  d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                  d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
      whole += volume[i];
    }
    if (whole == 0) continue;  // flat: its faces count twice or not at all
    if (whole < 0)
      for (Int128& each : volume) each = -each;
    const Int128 least = *std::min_element(volume.begin(), volume.end());
    if (least == 0) return std::nullopt;
    if (least > 0) odd = !odd;
  }
  return odd;
}

/// A solid of up to `most` tetrahedra, often none that has a boundary.
inline Solid draw_solid(Draw& draw, int most) {
  constexpr std::array coords{6, 8, 12, 16, 20, 24};
  const int n = draw.pick(coords);
  const std::array slopes{4, 8, 12, n};
  constexpr std::array fractions{0, 2};
  Solid made{{n, static_cast<int>(draw.integer(0, 2)), draw.pick(slopes), draw.pick(fractions)}, {}};
  const std::int64_t end = made.bits.largest_corner();
  const std::array<std::int64_t, 4> steps{1, 1, 2, std::max<std::int64_t>(1, end / 4)};
  const std::int64_t step = draw.pick(steps);
  std::vector<Corner> places(static_cast<std::size_t>(draw.integer(4, 3 + most)));
  for (Corner& place : places)
    for (std::int32_t& x : place)
      x = static_cast<std::int32_t>(std::clamp(step * draw.integer(-4, 4), -end, end));
  for (std::int64_t i = draw.integer(1, most); i > 0; --i) {
    Tetrahedron part;
    for (std::size_t k = 0; k < 4; ++k) {
      const auto other =
          draw.integer(static_cast<std::int64_t>(k), static_cast<std::int64_t>(places.size()) - 1);
      std::swap(places[k], places[static_cast<std::size_t>(other)]);
      part[k] = places[k];
    }
    const auto different = [&](std::size_t j, std::size_t k) { return part[j] != part[k]; };
    if (different(0, 1) && different(0, 2) && different(0, 3) && different(1, 2) && different(1, 3) &&
        different(2, 3))
      made.parts.push_back(part);
  }
  return made;
}

/// A ray without an end through a corner, an edge or the inside of a face, or along axes and diagonals. Nothing: it
/// would have no direction.
inline std::optional<IntRay> draw_ray(Draw& draw, const WorldBits& bits,
                                      const std::vector<IntTriangle>& mesh) {
  const std::int64_t end = bits.largest_corner();
  const bool anywhere = draw.one_in(2);
  Point origin{}, way{};
  for (std::int64_t& x : origin) {
    x = anywhere ? draw.integer(-end, end) : std::clamp<std::int64_t>(draw.integer(-8, 8), -end, end);
    x <<= bits.finer;
  }
  constexpr std::array<std::array<std::int64_t, 3>, 5> weights{
      {{1, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 1, 1}, {1, 2, 4}}};
  const auto& w = draw.pick(weights);
  const IntTriangle& aim = draw.pick(mesh);
  const bool by_axes = draw.integer(0, 9) < 3;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < 3; ++i) sum += w[i] * aim.corners[i][axis];
    way[axis] = by_axes ? draw.integer(-1, 1) : (sum << bits.finer) - (w[0] + w[1] + w[2]) * origin[axis];
  }
  if (way == Point{}) return std::nullopt;
  return Draw::along(bits, origin, way);
}

/// The other half of the line.
inline IntRay turned(IntRay ray) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    ray.direction[axis] = -ray.direction[axis];
    ray.negative[axis] = !ray.negative[axis];
  }
  return ray;
}

}  // namespace hitpipe::ref::tetrahedra
