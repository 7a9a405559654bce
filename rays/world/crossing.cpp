#include "rays/world/crossing.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "rays/world/int128.hpp"

namespace hitpipe::ref {

namespace {

using Way = std::array<std::int64_t, 3>;

/// Of numbers of at most 34 and 26 bits.
Way cross_product(const Way& p, const Way& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

/// In units of corners.
Way edge(const IntTriangle& triangle, std::size_t from, std::size_t to) {
  Way way{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    way[axis] = std::int64_t{triangle.corners[to][axis]} - triangle.corners[from][axis];
  return way;
}

template <class Number>
int sign_of(Number x) {
  return (x > 0 ? 1 : 0) - (x < 0 ? 1 : 0);
}

std::size_t slot_a(const IntRay& ray) {
  return ray.major == 1 ? 0 : 1;
}
std::size_t slot_b(const IntRay& ray) {
  return ray.major == 2 ? 0 : 2;
}

/// direction . (v1 - v0) x (v2 - v0). The components of the normal are below 2^49 in size.
int side_of(const IntRay& ray, const IntTriangle& triangle) {
  const Way normal = cross_product(edge(triangle, 0, 1), edge(triangle, 0, 2));
  Int128 sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) sum += static_cast<Int128>(ray.direction[axis]) * normal[axis];
  return sign_of(sum);
}

/// On which side of the moved ray is an edge that passes it at 0? With corners j and k seen from the origin, the
/// determinant of the edge is e = D . (j x k), and a move of the origin by d adds d . (D x (k - j)) to it. Both
/// components are 0 only if the edge is parallel to the ray; then det is 0.
int side_after_move(const IntRay& ray, const Way& edge) {
  const Way change = cross_product(ray.direction, edge);
  const int along_a = sign_of(change[slot_a(ray)]);
  return along_a != 0 ? along_a : sign_of(change[slot_b(ray)]);
}

}  // namespace

std::optional<Crossing> crossing_of(const IntRay& ray, const IntTriangle& triangle,
                                    const hls::WorldBits& bits) {
  const std::optional<IntCrossing> hit = int_crossing(ray, triangle, bits);
  if (!hit) return std::nullopt;
  Crossing found{.t = hit->t, .side = side_of(ray, triangle), .tie = false, .once = true};
  for (std::size_t i = 0; i < 3; ++i) {
    if (hit->e[i] != 0) continue;
    found.tie = true;
    if (side_after_move(ray, edge(triangle, (i + 1) % 3, (i + 2) % 3)) != found.side) found.once = false;
  }
  return found;
}

}  // namespace hitpipe::ref
