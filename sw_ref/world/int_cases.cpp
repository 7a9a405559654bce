#include "sw_ref/world/int_cases.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

#include "rays/world/int128.hpp"

namespace hitpipe::ref {

namespace {

using adversary::Random;
using hls::WorldBits;
using Point = std::array<std::int64_t, 3>;

std::int64_t number(Random& random, std::int64_t low, std::int64_t high) {
  return low + static_cast<std::int64_t>(random.below(static_cast<std::uint64_t>(high - low) + 1));
}
bool one_in(Random& random, int n) {
  return random.below(static_cast<std::uint64_t>(n)) == 0;
}

Point anywhere(Random& random, std::int64_t most) {
  return {number(random, -most, most), number(random, -most, most), number(random, -most, most)};
}

/// Within `size` of the place, and on the grid of corners.
IntTriangle::Corner corner_near(Random& random, const Point& place, std::int64_t size,
                                const WorldBits& bits) {
  const std::int64_t most = bits.largest_corner();
  IntTriangle::Corner corner{};
  for (std::size_t i = 0; i < 3; ++i)
    corner[i] = static_cast<std::int32_t>(std::clamp(place[i] + number(random, -size, size), -most, most));
  return corner;
}

IntTriangle triangle_of(Random& random, std::int64_t size, const WorldBits& bits) {
  const Point place = anywhere(random, bits.largest_corner());
  IntTriangle made;
  for (auto& corner : made.corners) corner = corner_near(random, place, size, bits);
  return made;
}

std::int64_t any_size(Random& random, const WorldBits& bits) {
  return std::int64_t{1} << random.below(static_cast<std::uint64_t>(bits.coord - 1));
}

Point any_origin(Random& random, const WorldBits& bits) {
  Point origin = anywhere(random, bits.largest_point());
  if (one_in(random, 4))
    for (std::int64_t& x : origin) x &= ~((std::int64_t{1} << bits.finer) - 1);
  return origin;
}

/// The ray that the door makes of this direction, which may be longer than the cube.
IntRay ray_along(const Point& origin, Point way, const WorldBits& bits) {
  IntRay ray;
  if (way == Point{}) way[2] = 1;
  for (std::size_t axis = 1; axis < 3; ++axis)
    if (std::abs(way[axis]) > std::abs(way[static_cast<std::size_t>(ray.major)]))
      ray.major = static_cast<int>(axis);
  const Int128 longest = std::abs(way[static_cast<std::size_t>(ray.major)]);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Int128 size = static_cast<Int128>(std::abs(way[axis])) << bits.slope;
    const auto slope = static_cast<std::int64_t>((2 * size + longest) / (2 * longest));
    ray.origin[axis] = origin[axis];
    ray.negative[axis] = way[axis] < 0;
    ray.direction[axis] = way[axis] < 0 ? -slope : slope;
  }
  ray.length = bits.largest_distance();
  return ray;
}

/// From anywhere toward the point with these weights of the corners.
IntRay aimed(Random& random, const IntTriangle& triangle, const std::array<std::int64_t, 3>& weights,
             const WorldBits& bits) {
  const Point origin = any_origin(random, bits);
  const std::int64_t sum = weights[0] + weights[1] + weights[2];
  Point way{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 3; ++i) way[axis] += weights[i] * triangle.corners[i][axis];
    way[axis] = (way[axis] << bits.finer) - sum * origin[axis];
  }
  return ray_along(origin, way, bits);
}

std::array<std::int64_t, 3> inner_weights(Random& random) {
  return {number(random, 1, 9), number(random, 1, 9), number(random, 1, 9)};
}

/// A ray and a point of the grid that it goes through exactly.
struct Through {
  IntRay ray;
  Point point{};
};

/// Slopes are multiples of 1/4, so that it comes to points of the grid.
Through through_a_point(Random& random, const WorldBits& bits) {
  const std::int64_t most = bits.largest_corner();
  Through made;
  Point way{4, number(random, -4, 4), number(random, -4, 4)};
  if (random.coin()) way[0] = -4;
  std::swap(way[0], way[static_cast<std::size_t>(random.axis())]);
  made.point = anywhere(random, most);
  std::int64_t steps = number(random, 0, most / 2);
  Point start{};
  for (bool inside = false; !inside; steps /= 2) {
    inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      start[i] = made.point[i] - steps * way[i];
      inside = inside && std::abs(start[i]) <= most;
    }
  }
  for (std::int64_t& x : start) x <<= bits.finer;
  made.ray = ray_along(start, way, bits);
  return made;
}

IntCase make_anywhere(Random& random, const WorldBits& bits) {
  return {ray_along(any_origin(random, bits), anywhere(random, 1 << 20), bits),
          triangle_of(random, any_size(random, bits), bits)};
}

IntCase make_inside(Random& random, const WorldBits& bits) {
  const IntTriangle triangle = triangle_of(random, any_size(random, bits), bits);
  return {aimed(random, triangle, inner_weights(random), bits), triangle};
}

/// Exactly through an edge, or toward it.
IntCase make_edge(Random& random, const WorldBits& bits) {
  const auto size = any_size(random, bits);
  if (one_in(random, 3)) {
    const IntTriangle triangle = triangle_of(random, size, bits);
    return {aimed(random, triangle, {number(random, 1, 9), number(random, 1, 9), 0}, bits), triangle};
  }
  const Through through = through_a_point(random, bits);
  const std::int64_t most = bits.largest_corner();
  IntCase made{through.ray, {}};
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t room = std::min(size, most - std::abs(through.point[i]));
    const std::int64_t away = number(random, -room, room);
    made.triangle.corners[0][i] = static_cast<std::int32_t>(through.point[i] + away);
    made.triangle.corners[1][i] = static_cast<std::int32_t>(through.point[i] - away);
  }
  made.triangle.corners[2] = corner_near(random, through.point, size, bits);
  return made;
}

/// Exactly through a corner, or toward it.
IntCase make_corner(Random& random, const WorldBits& bits) {
  const auto size = any_size(random, bits);
  if (one_in(random, 3)) {
    const IntTriangle triangle = triangle_of(random, size, bits);
    return {aimed(random, triangle, {1, 0, 0}, bits), triangle};
  }
  const Through through = through_a_point(random, bits);
  IntCase made{through.ray, {}};
  for (auto& corner : made.triangle.corners) corner = corner_near(random, through.point, size, bits);
  made.triangle.corners[0] = corner_near(random, through.point, 0, bits);
  return made;
}

/// In the plane of the triangle: along an edge, or from one corner to anywhere in the plane.
IntCase make_plane(Random& random, const WorldBits& bits) {
  const Through through = through_a_point(random, bits);
  const auto size = any_size(random, bits);
  IntCase made{through.ray, {}};
  const std::int64_t most = bits.largest_corner();
  // Two corners on the ray's line, or as near to it as the cube allows.
  for (std::size_t k = 0; k < 3; ++k)
    made.triangle.corners[k] = corner_near(random, through.point, k < 2 ? 0 : size, bits);
  const std::int64_t steps = number(random, 1, 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::int64_t moved = through.point[i] + steps * (made.ray.direction[i] >> (bits.slope - 2));
    made.triangle.corners[1][i] = static_cast<std::int32_t>(std::clamp(moved, -most, most));
  }
  if (random.coin())
    made.ray = ray_along(any_origin(random, bits),
                         {made.ray.direction[0], made.ray.direction[1], made.ray.direction[2]}, bits);
  return made;
}

IntCase make_small(Random& random, const WorldBits& bits) {
  const IntTriangle triangle = triangle_of(random, number(random, 1, 4), bits);
  const bool at_an_edge = random.coin();
  return {aimed(random, triangle, at_an_edge ? std::array<std::int64_t, 3>{1, 1, 0} : inner_weights(random),
                bits),
          triangle};
}

IntCase make_sliver(Random& random, const WorldBits& bits) {
  IntTriangle triangle = triangle_of(random, any_size(random, bits), bits);
  const auto& first = triangle.corners[0];
  triangle.corners[1] = corner_near(random, {first[0], first[1], first[2]}, 1, bits);
  return {aimed(random, triangle, inner_weights(random), bits), triangle};
}

/// Slopes of 0, of 1 unit, of 2^S and of one unit less.
IntCase make_axis(Random& random, const WorldBits& bits) {
  IntCase made = make_inside(random, bits);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (static_cast<int>(axis) == made.ray.major || one_in(random, 3)) continue;
    const std::array<std::int64_t, 4> slopes{0, 1, bits.one() - 1, bits.one()};
    // Ties of the largest component go to the lower axis.
    std::int64_t slope = slopes[random.below(4)];
    if (static_cast<int>(axis) < made.ray.major) slope = std::min(slope, bits.one() - 1);
    made.ray.direction[axis] = made.ray.negative[axis] ? -slope : slope;
    made.ray.origin[axis] = std::int64_t{made.triangle.corners[random.below(3)][axis]} << bits.finer;
  }
  return made;
}

/// Every number at the end of its range, or next to it.
IntCase make_extreme(Random& random, const WorldBits& bits) {
  const auto end = [&](std::int64_t most) {
    const std::int64_t size = most - (one_in(random, 4) ? 1 : 0);
    return random.coin() ? size : -size;
  };
  IntCase made = make_axis(random, bits);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!one_in(random, 8)) made.ray.origin[axis] = end(bits.largest_point());
    for (auto& corner : made.triangle.corners)
      if (!one_in(random, 8)) corner[axis] = static_cast<std::int32_t>(end(bits.largest_corner()));
  }
  return made;
}

/// The largest determinants: the widest triangle of the cube and a ray along its normal. The ray starts in
/// a corner of the triangle, or in the corner of the cube from which its volume is the largest.
IntCase make_widest(Random& random, const WorldBits& bits) {
  const auto one_less = [&] { return one_in(random, 4) ? 1 : 0; };
  IntCase made;
  std::array<bool, 3> negative{random.coin(), random.coin(), random.coin()};
  const std::size_t first = random.below(3);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int64_t size = bits.largest_corner() - one_less();
      const bool same_side = (i + first) % 3 == axis;
      made.triangle.corners[i][axis] = static_cast<std::int32_t>(same_side == negative[axis] ? -size : size);
    }
  }
  made.ray.length = bits.largest_distance();
  made.ray.major = static_cast<int>(random.below(3));
  const auto major = static_cast<std::size_t>(made.ray.major);
  const bool onward = random.coin();
  const std::size_t corner = random.below(4);
  for (std::size_t axis = 0; axis < 3; ++axis) {
    made.ray.origin[axis] = corner < 3       ? std::int64_t{made.triangle.corners[corner][axis]} << bits.finer
                            : negative[axis] ? -bits.largest_point() + one_less()
                                             : bits.largest_point() - one_less();
    // From the opposite corner it goes to the triangle.
    made.ray.negative[axis] = negative[axis] != (onward || corner == 3);
    // Ties of the largest component go to the lower axis.
    const std::int64_t slope = bits.one() - (axis == major ? 0 : axis < major ? 1 : one_less());
    made.ray.direction[axis] = made.ray.negative[axis] ? -slope : slope;
  }
  return made;
}

IntCase make_flat(Random& random, const WorldBits& bits) {
  IntCase made = make_inside(random, bits);
  auto& corners = made.triangle.corners;
  corners[2] = corners[random.below(2)];
  if (one_in(random, 4)) corners[1] = corners[0];
  return made;
}

/// The origin is on the triangle, or a unit beside it.
IntCase make_touching(Random& random, const WorldBits& bits) {
  IntCase made = random.coin() ? make_corner(random, bits) : make_edge(random, bits);
  const auto& corner = made.triangle.corners[0];
  const auto& other = made.triangle.corners[1];
  const bool middle = random.coin();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::int64_t twice =
        middle ? std::int64_t{corner[axis]} + other[axis] : 2 * std::int64_t{corner[axis]};
    const std::int64_t place = bits.finer == 0 ? twice / 2 : twice << (bits.finer - 1);
    const std::int64_t beside = one_in(random, 3) ? number(random, -1, 1) : 0;
    made.ray.origin[axis] = std::clamp(place + beside, -bits.largest_point(), bits.largest_point());
  }
  return made;
}

/// Corners at these ways from a point of the ray, in any order. Nothing: one is outside the cube.
std::optional<IntCase> at_ways(Random& random, const Through& through, const std::array<Point, 3>& ways,
                               const WorldBits& bits) {
  IntCase made{through.ray, {}};
  const std::size_t first = random.below(3);
  const bool turned = random.coin();
  for (std::size_t i = 0; i < 3; ++i) {
    auto& corner = made.triangle.corners[turned ? (first + i) % 3 : (first + 3 - i) % 3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::int64_t place = through.point[axis] + ways[i][axis];
      if (std::abs(place) > bits.largest_corner()) return std::nullopt;
      corner[axis] = static_cast<std::int32_t>(place);
    }
  }
  return made;
}

Point sum_of(const Point& p, const Point& q, std::int64_t times) {
  return {p[0] + times * q[0], p[1] + times * q[1], p[2] + times * q[2]};
}

/// The direction on the grid of corners.
Point step_of(const Through& through, const WorldBits& bits) {
  Point step{};
  for (std::size_t axis = 0; axis < 3; ++axis) step[axis] = through.ray.direction[axis] >> (bits.slope - 2);
  return step;
}

/// Two corners are in the plane of the ray and slot a, so a move along slot a adds 0 to the number of their edge.
/// The ray goes through the middle of the edge or through a corner.
IntCase make_tie(Random& random, const WorldBits& bits) {
  for (;;) {
    const Through through = through_a_point(random, bits);
    const std::int64_t size = any_size(random, bits);
    Point way{};
    way[through.ray.major == 1 ? 0 : 1] = number(random, -size, size);
    way = sum_of(way, step_of(through, bits), number(random, -2, 2));
    const Point other = one_in(random, 3) ? Point{} : sum_of({}, way, -1);
    const Point third = anywhere(random, std::min(size, bits.largest_corner()));
    if (const auto made = at_ways(random, through, {way, other, third}, bits)) return *made;
  }
}

/// The third corner is beside the plane of the ray and the first two. The ray goes through the middle of their
/// edge or through a corner, so det is near 0 and the hit a tie.
IntCase make_edge_on(Random& random, const WorldBits& bits) {
  for (;;) {
    const Through through = through_a_point(random, bits);
    const Point way = anywhere(random, std::min(any_size(random, bits), bits.largest_corner()));
    const Point other = one_in(random, 3) ? Point{} : sum_of({}, way, -1);
    const Point beside = sum_of(anywhere(random, 1), way, number(random, -1, 1));
    const Point third = sum_of(beside, step_of(through, bits), number(random, -3, 3));
    if (const auto made = at_ways(random, through, {way, other, third}, bits)) return *made;
  }
}

constexpr std::array<IntCategory, 14> all_categories{{
    {"anywhere", "any ray and any triangle", make_anywhere},
    {"inside", "aimed at the inside of a triangle", make_inside},
    {"edge", "through an edge", make_edge},
    {"corner", "through a corner", make_corner},
    {"plane", "in the plane of the triangle, or along an edge", make_plane},
    {"small", "triangles of a few units", make_small},
    {"sliver", "two corners are neighbours", make_sliver},
    {"axis", "slopes of 0, of one unit and of 1", make_axis},
    {"extreme", "numbers at the ends of their ranges", make_extreme},
    {"widest", "determinants at the ends of their ranges", make_widest},
    {"flat", "equal corners", make_flat},
    {"touching", "the ray starts on the triangle", make_touching},
    {"tie", "through an edge that needs the second part of the move", make_tie},
    {"edge_on", "through an edge of a triangle that is nearly in the ray's plane", make_edge_on},
}};

}  // namespace

std::span<const IntCategory> int_categories(const WorldBits& bits) {
  constexpr std::size_t about_ties = 2;
  return std::span(all_categories).first(all_categories.size() - (bits.crossings == 0 ? about_ties : 0));
}

void int_neighbours(Random& random, const IntTriangle& triangle, const WorldBits& bits,
                    std::span<IntTriangle> out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i] = triangle;
    if (i == 0) continue;
    auto& corners = out[i].corners;
    const std::size_t one = random.below(3);
    const auto& place = corners[one];
    switch (random.below(4)) {
      case 0:
        std::swap(corners[one], corners[(one + 1) % 3]);
        break;
      case 1:
        corners[one] = corner_near(random, {place[0], place[1], place[2]}, any_size(random, bits), bits);
        break;
      default:
        corners[one] = corner_near(random, {place[0], place[1], place[2]}, 1, bits);
    }
  }
}

}  // namespace hitpipe::ref
