// The exact triangle test of the integer world (docs/integer_world.md). A ray hits the closed triangle from
// either side. A ray in the plane of a triangle never hits it. There is no epsilon: all numbers are integers,
// and none is rounded but T.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "hls/world/world_format.hpp"
#include "rays/world/int128.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::ref {

/// Where a ray meets a triangle. The weights of the corners are e[i] / det.
struct IntCrossing {
  std::int64_t t = 0;         ///< floor(2^F distance along the major axis), 0..largest_distance()
  std::array<Int128, 3> e{};  ///< at least 0
  Int128 det = 0;             ///< e[0] + e[1] + e[2], at least 1
};

/// Nothing when the ray does not meet the triangle within its length.
[[nodiscard]] std::optional<IntCrossing> int_crossing(const IntRay& ray, const IntTriangle& triangle,
                                                      const hls::WorldBits& bits);

/// The best hit so far: the least T, and of equal ones the lowest triangle. It does not depend on the order
/// of tests.
struct IntHit {
  static constexpr std::uint32_t none = ~0U;

  std::uint32_t triangle = none;
  std::int64_t t = 0;

  [[nodiscard]] bool found() const { return triangle != none; }
};

/// Keeps (t, triangle) in `best` if it is better. True if `best` changed.
inline bool keep_better(std::int64_t t, std::uint32_t triangle, IntHit& best) {
  if (best.found() && (t > best.t || (t == best.t && triangle >= best.triangle))) return false;
  best = {triangle, t};
  return true;
}

}  // namespace hitpipe::ref
