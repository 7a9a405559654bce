// A coarser grid on single axes: origins and boxes of the n-bit grid, moved outward to multiples of 2^k. The
// operands keep n bits. Their low k bits are 0, so a unit need not store them or compute with them.
// Directions, inverse directions, lengths and endpoints do not change.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "rays/world/int_box.hpp"

namespace hitpipe::ref {

/// The low bits that are dropped from coordinates.
struct CoarseAxes {
  std::array<int, 3> dropped{};  ///< k of x, y, z; 0..n-2

  [[nodiscard]] bool any() const { return dropped != std::array<int, 3>{}; }
  friend bool operator==(const CoarseAxes&, const CoarseAxes&) = default;
};

using IntOrigin = std::array<std::int32_t, 3>;

/// Throws std::invalid_argument unless each k is in 0..n-2. `who` opens the message.
void check_coarse(const CoarseAxes& coarse, int coord_bits, std::string_view who);

/// Cuts off the low bits of a rounded origin, and grows a rounded box to make up for that. The units then
/// still miss nothing (proof in coarse_axes.cpp). Throws std::out_of_range if the cut origin or the grown box
/// leaves the grid. `coarse` must be checked.
[[nodiscard]] IntOrigin coarse_origin(const IntOrigin& origin, const CoarseAxes& coarse, int coord_bits);
[[nodiscard]] IntBox coarse_box(const IntBox& box, const CoarseAxes& coarse, int coord_bits);

/// Whether all origins that are not lower than this one, and all boxes within these bounds, stay on the grid.
[[nodiscard]] bool fits_grid(const IntOrigin& lowest_origin, const IntBox& bounds, const CoarseAxes& coarse,
                             int coord_bits);

/// For example "y 1, z 2", or "none".
[[nodiscard]] std::string to_text(const CoarseAxes& coarse);

}  // namespace hitpipe::ref
