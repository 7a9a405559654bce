// Triangles of a leaf, four side by side, and a test that discards those which a ray surely misses.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include "rays/exact/exact_triangle.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"

namespace hitpipe::ref {

struct alignas(64) TrianglePack {
  static constexpr std::size_t size = 4;

  float corners[9][size] = {};    ///< x, y, z of corner a, then b, then c
  float longest_side[size] = {};  ///< no component of b - a, c - b or a - c is longer
  std::uint32_t triangles[size] = {};

  void set(std::size_t lane, std::uint32_t triangle, const Mesh::Corners& its) {
    triangles[lane] = triangle;
    float longest = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float low = std::fmin(std::fmin(its.a[axis], its.b[axis]), its.c[axis]);
      const float high = std::fmax(std::fmax(its.a[axis], its.b[axis]), its.c[axis]);
      longest = std::fmax(longest, high - low);
      corners[axis][lane] = its.a[axis];
      corners[3 + axis][lane] = its.b[axis];
      corners[6 + axis][lane] = its.c[axis];
    }
    longest_side[lane] = longest;
  }
  [[nodiscard]] Mesh::Corners at(std::size_t lane) const {
    return {{corners[0][lane], corners[1][lane], corners[2][lane]},
            {corners[3][lane], corners[4][lane], corners[5][lane]},
            {corners[6][lane], corners[7][lane], corners[8][lane]}};
  }
};

/// Discards by the side on which the ray's line passes each edge, in binary32. Seen from the ray's origin,
///     d . (a x b) = (d x a) . (b - a),   d . (c x a) = (d x a) . (a - c),   d . (b x c) = (d x b) . (c - b),
/// triple products of d, which is exact, a corner and a side, each of them a rounded difference. The argument
/// of triangle_filter::exact_row_bound holds of them with u = 2^-24: they err by at most
///     16 u |d|_1 |corner|_max |side|_max.
/// Sides are as long as the pack says, up to a rounding that the 16 covers as it does those of the norms: there are 14
/// where it says 16. Corners are within `reach` of the origin, by coordinates. Products that underflow lose 2^-150
/// each: two in a component of the moment, which a side then multiplies, and three in the dot product. That adds less
/// than 2^-147 |side|_max + 2^-148. With corners up to 2^25 and |d|_1 reach up to 2^90 nothing overflows; for others
/// nothing is discarded.
///
/// The ray may be a rounded one, its direction by u of each component and its origin by u reach. That is a rounding
/// more of the row d and 2 u |d|_1 reach |side|_max for the origin: 18 in place of 14, so a reach of half as much again
/// covers both.
template <class Lanes>
class TriangleFilter {
 public:
  TriangleFilter(const Ray& ray, float reach) {
    float sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      origin_[axis] = Floats{} + ray.origin[axis];
      direction_[axis] = Floats{} + ray.direction[axis];
      sum += std::fabs(ray.direction[axis]);
    }
    const float largest = sum * reach;
    factor_ = largest <= 0x1p90F ? 16 * 0x1p-24F * largest + least : std::numeric_limits<float>::infinity();
  }

  /// Bit i: the ray may hit triangle i of the pack.
  [[nodiscard]] unsigned may_hit(const TrianglePack& pack) const {
    static_assert(Lanes::count == TrianglePack::size);
    const Vector a = corner(pack, 0);
    const Vector b = corner(pack, 1);
    const Vector c = corner(pack, 2);
    const Vector moment_a = cross(direction_, difference(a, origin_));
    const Vector moment_b = cross(direction_, difference(b, origin_));
    const Floats ab = dot(moment_a, difference(b, a));
    const Floats ca = dot(moment_a, difference(a, c));
    const Floats bc = dot(moment_b, difference(c, b));
    Floats lowest = ab < ca ? ab : ca;
    lowest = bc < lowest ? bc : lowest;
    Floats highest = ab > ca ? ab : ca;
    highest = bc > highest ? bc : highest;
    const Floats error = load(pack.longest_side) * factor_ + least;
    // An infinite error discards nothing, whatever overflowed.
    return ~Lanes::bits((lowest < -error) & (highest > error));
  }

 private:
  using Floats = typename Lanes::Floats;
  static constexpr float least = 0x1p-146F;
  struct Vector {
    Floats axes[3];
    Floats& operator[](int axis) { return axes[axis]; }
    const Floats& operator[](int axis) const { return axes[axis]; }
  };

  static Floats load(const float* from) {
    Floats loaded;
    std::memcpy(&loaded, from, sizeof loaded);
    return loaded;
  }
  static Vector corner(const TrianglePack& pack, std::size_t which) {
    return {{load(pack.corners[3 * which]), load(pack.corners[3 * which + 1]),
             load(pack.corners[3 * which + 2])}};
  }
  static Vector difference(const Vector& a, const Vector& b) {
    return {{a[0] - b[0], a[1] - b[1], a[2] - b[2]}};
  }
  static Vector cross(const Vector& a, const Vector& b) {
    return {{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]}};
  }
  static Floats dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

  Vector origin_, direction_;
  float factor_;
};

}  // namespace hitpipe::ref
