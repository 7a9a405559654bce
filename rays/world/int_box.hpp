// Boxes on the integer grid (section 6.2.1). They are grown by half a unit of the ray origin's grid, because
// the origin is rounded, and then rounded outward.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rays/mesh/aabb.hpp"

namespace hitpipe::ref {

/// n-bit coordinates, x, y, z; |coordinate| <= G + 1 (grid.hpp).
struct IntBox {
  std::array<std::int32_t, 3> min{};
  std::array<std::int32_t, 3> max{};

  friend bool operator==(const IntBox&, const IntBox&) = default;
};

/// The smallest box that holds both.
[[nodiscard]] inline IntBox union_of(const IntBox& a, const IntBox& b) {
  IntBox both;
  for (std::size_t i = 0; i < 3; ++i) {
    both.min[i] = std::min(a.min[i], b.min[i]);
    both.max[i] = std::max(a.max[i], b.max[i]);
  }
  return both;
}

/// min = floor(G * min - h), max = ceil(G * max + h), both exact, with h = 1/2, or 2^-(g+1) for origins on a
/// grid that is finer by g bits (`finer`, 0..3). `coord_bits` is n, 6..32. Throws std::out_of_range if a
/// coordinate is not a number or ends beyond G + 1 (no coordinate in [-1, 1] does), std::invalid_argument for
/// another n.
[[nodiscard]] IntBox quantise_box(const Aabb& box, int coord_bits, int finer = 0);

/// The same for many boxes, which is faster. `out` has as many places as `boxes`.
void quantise_boxes(std::span<const Aabb> boxes, int coord_bits, std::span<IntBox> out, int finer = 0);

}  // namespace hitpipe::ref
