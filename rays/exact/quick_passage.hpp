// A line and a triangle in integers of 128 bits, where their numbers allow: exact as Passage is, and an order of
// magnitude quicker. Only .cpp files of rays/exact include this.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

/// Places are in units of 2^(p - 38), where p is the least with all of them below 2^p, and so are directions with
/// their own p. A place or a direction is then below 2^38, a difference below 2^39, an edge below 2^119, the
/// determinant and the height below 2^121.
struct QuickPassage {
  __extension__ typedef __int128 Number;

  std::array<Number, 3> edges{};  ///< as Passage::edges
  Number height = 0;              ///< as Passage::height()
  int time_exponent = 0;          ///< t is height / determinant() times 2 to it

  [[nodiscard]] Number determinant() const { return edges[0] + edges[1] + edges[2]; }

  /// Nothing if a number is no multiple of its unit.
  static std::optional<QuickPassage> of(const Mesh::Corners& corners, const Ray& ray) {
    const int places = exponent_above(
        std::max({largest(corners.a), largest(corners.b), largest(corners.c), largest(ray.origin)}));
    const int directions = exponent_above(largest(ray.direction));
    Way origin{}, a{}, b{}, c{}, direction{};
    const bool whole = in_units(ray.origin, places, origin) && in_units(corners.a, places, a) &&
                       in_units(corners.b, places, b) && in_units(corners.c, places, c) &&
                       in_units(ray.direction, directions, direction);
    if (!whole) return std::nullopt;
    for (Way* corner : {&a, &b, &c})
      for (std::size_t axis = 0; axis < 3; ++axis) (*corner)[axis] -= origin[axis];
    const Minors b_cross_c = cross(b, c);
    QuickPassage made;
    made.edges = {dot(direction, b_cross_c), dot(direction, cross(c, a)), dot(direction, cross(a, b))};
    made.height = dot(a, b_cross_c);
    made.time_exponent = places - directions;
    return made;
  }

 private:
  using Way = std::array<std::int64_t, 3>;
  using Minors = std::array<Number, 3>;
  static constexpr int size_bits = 38;

  static float largest(const glm::vec3& v) {
    return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
  }
  /// x < 2^p for it, x >= 0. Subnormal numbers take the least exponent of normal ones.
  static int exponent_above(float x) {
    return static_cast<int>(std::bit_cast<std::uint32_t>(x) >> 23U) - 126;
  }
  static bool in_units(const glm::vec3& v, int exponent, Way& units) {
    const auto scale = std::bit_cast<double>(static_cast<std::uint64_t>(size_bits - exponent + 1023) << 52U);
    bool whole = true;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double scaled = static_cast<double>(v[static_cast<int>(axis)]) * scale;
      units[axis] = static_cast<std::int64_t>(scaled);
      whole = whole && static_cast<double>(units[axis]) == scaled;
    }
    return whole;
  }
  static Minors cross(const Way& p, const Way& q) {
    const auto minor = [&](std::size_t i, std::size_t j) {
      return static_cast<Number>(p[i]) * q[j] - static_cast<Number>(p[j]) * q[i];
    };
    return {minor(1, 2), minor(2, 0), minor(0, 1)};
  }
  static Number dot(const Way& p, const Minors& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; }
};

}  // namespace hitpipe::ref
