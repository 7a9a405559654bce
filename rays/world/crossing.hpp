// Exactly once (docs/integer_world.md): which hits of a closed triangle test count, so that a line crosses a
// closed mesh an even number of times, always. A ray through an edge or a corner hits every triangle there.
// Such a hit is a tie. It counts if the triangle holds the ray after a move of eps along slot a and eps^2
// along slot b, for an eps that is less than any number: where an edge passes the ray at 0, the move decides.
// No number of the ray or the triangle is moved or rounded. A ray in the plane of a triangle never hits it.
//
// Slots m, a and b are those of the triangle unit (hls/world/triangle_operands.hpp): m is the major axis M, a is y
// and b is z, and where one of these is M, x takes its place. The direction's sign does not turn the move.
#pragma once

#include <cstdint>
#include <optional>

#include "hls/world/world_format.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_triangle.hpp"

namespace hitpipe::ref {

/// A hit of the closed triangle, as int_crossing() has it, and whether it counts.
struct Crossing {
  std::int64_t t = 0;  ///< as IntCrossing::t, 0..largest_distance()
  int side = 0;        ///< the sign of direction . (v1 - v0) x (v2 - v0), which is never 0
  bool tie = false;    ///< at an edge or a corner; it counts or not
  bool once = false;   ///< it counts; true for all that are no tie
};

/// Nothing when int_crossing() is nothing. A hit at the origin itself, where T is 0, is as any other. The ray and
/// the triangle are in the ranges of the format, of which bits.proved().
[[nodiscard]] std::optional<Crossing> crossing_of(const IntRay& ray, const IntTriangle& triangle,
                                                  const hls::WorldBits& bits);

}  // namespace hitpipe::ref
