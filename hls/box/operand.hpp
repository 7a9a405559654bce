// What a design says about its ports, and what it is. Set-up, tests, fit and manifests read these lists. None
// of them reads a meaning from a port's name.
#pragma once

#include <cstdint>

namespace hitpipe {
namespace hls {

enum class Axis { none, x, y, z };

/// What an operand tells the unit.
enum class Role {
  origin,        ///< of the ray
  origin_high,   ///< upper bound of the origin; `origin` is then the lower bound
  endpoint,      ///< of the ray
  direction,     ///< of the ray
  inverse,       ///< reciprocal of a direction component
  inverse_low,   ///< lower bound of a reciprocal
  inverse_high,  ///< upper bound of a reciprocal
  length,        ///< of the ray
  endless,       ///< 1: the ray has no end, so length or endpoint is ignored
  plane_low,     ///< lower plane of a box
  plane_high,    ///< upper plane of a box
  exponent,      ///< power of two that belongs to bounds of a reciprocal
  backward,      ///< 1: the ray's direction is negative
  entry,         ///< distance at which the ray enters a parent box
  owner,         ///< which of two boxes has a plane
  major,         ///< 1: the direction is largest along this axis
  other,         ///< only the design's own set-up knows it
  corner,        ///< of a triangle
};

/// How an operand's bits are read.
enum class Kind {
  integer,  ///< two's complement
  natural,  ///< unsigned
  real,     ///< the pattern of a float
  flag,     ///< one bit
};

/// An operand port. Its numbers are two's complement for an integer, unsigned for a natural number, and the
/// pattern for a float.
struct Operand {
  const char* name;
  Role role;
  Axis axis;
  Kind kind;
  int width;               ///< bits
  std::int64_t low, high;  ///< the set-up gives only numbers in low..high
  int box;                 ///< number of the box that a plane is of, or of the corner; from 0

  constexpr bool is_signed() const { return kind == Kind::integer; }
};

/// An integer between -limit and limit.
constexpr Operand integer_operand(const char* name, Role role, Axis axis, int width, std::int64_t limit) {
  return {name, role, axis, Kind::integer, width, -limit, limit, 0};
}
/// A length: an integer from 0 to the largest number of the port.
constexpr Operand length_operand(const char* name, int width) {
  return {name, Role::length, Axis::none, Kind::integer, width, 0, (std::int64_t{1} << (width - 1)) - 1, 0};
}
/// A float with any pattern. It may be a zero of either sign, infinite or NaN.
constexpr Operand real_operand(const char* name, Role role, Axis axis, int width) {
  return {name, role, axis, Kind::real, width, 0, (std::int64_t{1} << width) - 1, 0};
}
constexpr Operand flag_operand(const char* name, Role role) {
  return {name, role, Axis::none, Kind::flag, 1, 0, 1, 0};
}

/// What a result tells the traversal.
enum class Meaning {
  hit,    ///< 1: the ray meets the box, or the triangle
  entry,  ///< distance at which the ray enters the box
  exit,   ///< distance at which the ray leaves the box
  order,  ///< 1: the second box comes first
  // Of a triangle test: numbers in two halves, the high one with the sign (hls/world/triangle_operands.hpp).
  determinant,
  determinant_low,
  volume,
  volume_low,
  edge_u,
  edge_u_low,
  edge_v,
  edge_v_low,
  // Of an integer ray (hls/world/ray_operands.hpp). `object` is the axis or ray axis, where there are
  // several.
  error,          ///< 1: there is no such ray
  axis,           ///< 1: the direction is largest along this axis
  back,           ///< 1: the direction is negative along this ray axis
  origin,         ///< of the ray
  slope,          ///< magnitude of the direction, divided by its largest component
  mantissa_low,   ///< lower bound of a slope's reciprocal
  mantissa_high,  ///< upper bound of a slope's reciprocal
  exponent,       ///< power of two that belongs to both bounds
  length,         ///< of the ray
  // Of a hit of a triangle, with a meaning only if HIT is 1.
  tie,   ///< 1: at an edge or a corner
  once,  ///< 1: it counts as a crossing
  side,  ///< 1: the determinant is negative
  // Of a triangle test, whatever its HIT: a bit for each edge.
  zero,   ///< 1: the edge meets the ray
  inner,  ///< 1: the ray passes the edge on the inner side; nothing if it meets it
};

/// A result port.
struct Result {
  const char* name;
  Meaning meaning;
  int box;  ///< number of the box or triangle that it answers for, from 0
  int width;
  bool is_signed;
  const char* object = "box";  ///< what it answers for, or what it is of
};

/// A set of meanings.
using Meanings = unsigned;
constexpr Meanings meanings() {
  return 0;
}
template <class... Others>
constexpr Meanings meanings(Meaning first, Others... others) {
  return 1U << static_cast<unsigned>(first) | meanings(others...);
}

/// What a design is. Code that drives a design asks for its kind and never for its name. Another kind is
/// another constant.
struct DesignKind {
  const char* name;      ///< as manifests have it
  int objects;           ///< how many boxes, or what else it tests, one test answers for
  Meanings of_each;      ///< a design of this kind has these results for each object
  Meanings of_the_test;  ///< and these once
  bool of_boxes = true;  ///< false: its objects are no boxes, so commands about boxes pass it over
};
/// Does the ray meet the box?
constexpr DesignKind box_kind{"box", 1, meanings(Meaning::hit), meanings()};
/// Where does the ray meet the two children of a parent, and which comes first?
constexpr DesignKind pair_kind{"pair", 2, meanings(Meaning::hit, Meaning::entry, Meaning::exit),
                               meanings(Meaning::order)};
/// Does the ray meet the triangle, and where?
constexpr DesignKind triangle_kind{
    "triangle", 1, meanings(Meaning::hit),
    meanings(Meaning::determinant, Meaning::determinant_low, Meaning::volume, Meaning::volume_low), false};
/// Which integer ray is a ray of floats? It tests no box and has no HIT.
constexpr DesignKind ray_kind{
    "ray", 1, meanings(),
    meanings(Meaning::error, Meaning::axis, Meaning::back, Meaning::origin, Meaning::slope,
             Meaning::mantissa_low, Meaning::mantissa_high, Meaning::exponent, Meaning::length),
    false};

constexpr bool operator==(const DesignKind& a, const DesignKind& b) {
  const char* y = b.name;
  for (const char* x = a.name; *x != 0 || *y != 0; ++x, ++y) {
    if (*x != *y) return false;
  }
  return true;
}

}  // namespace hls
}  // namespace hitpipe
