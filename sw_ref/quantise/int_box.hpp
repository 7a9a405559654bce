// Boxes on the integer grid (section 6.2.1). They are grown by half a unit, because the ray origin is
// rounded, and then rounded outward.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "sw_ref/geometry/aabb.hpp"

namespace hitpipe::ref {

/// n-bit coordinates, x, y, z; |coordinate| <= G + 1 (grid.hpp).
struct IntBox {
  std::array<std::int32_t, 3> min{};
  std::array<std::int32_t, 3> max{};

  friend bool operator==(const IntBox&, const IntBox&) = default;
};

/// min = floor(G * min - 1/2), max = ceil(G * max + 1/2), both exact. `coord_bits` is n, 6..32. Throws
/// std::out_of_range if a coordinate is not a number or ends beyond G + 1 (no coordinate in [-1, 1] does),
/// std::invalid_argument for another n.
[[nodiscard]] IntBox quantise_box(const Aabb& box, int coord_bits);

/// The same for many boxes, which is faster. `out` has as many places as `boxes`.
void quantise_boxes(std::span<const Aabb> boxes, int coord_bits, std::span<IntBox> out);

}  // namespace hitpipe::ref
