// A coarser grid on single axes: origins and boxes of the n-bit grid, moved outward to multiples of 2^k. The
// operands keep n bits, of which the low k are 0 and need neither be stored nor computed with. Directions,
// inverse directions, lengths and endpoints stay as they are.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "sw_ref/quantise/int_box.hpp"

namespace hitpipe::ref {

/// Low bits that coordinates do without.
struct CoarseAxes {
  std::array<int, 3> dropped{};  ///< k of x, y, z; 0..n-2

  [[nodiscard]] bool any() const { return dropped != std::array<int, 3>{}; }
  friend bool operator==(const CoarseAxes&, const CoarseAxes&) = default;
};

using IntOrigin = std::array<std::int32_t, 3>;

/// Throws std::invalid_argument unless each k is in 0..n-2. `who` opens the message.
void check_coarse(const CoarseAxes& coarse, int coord_bits, std::string_view who);

/// The low bits of the rounded origin cut off, the rounded box grown for it: what the units do with them
/// misses nothing (coarse_axes.cpp). Throws std::out_of_range where the cut origin or the grown box leaves
/// the grid. For a checked `coarse`.
[[nodiscard]] IntOrigin coarse_origin(const IntOrigin& origin, const CoarseAxes& coarse, int coord_bits);
[[nodiscard]] IntBox coarse_box(const IntBox& box, const CoarseAxes& coarse, int coord_bits);

/// Whether origins no lower than this, and boxes within this one, stay on the grid.
[[nodiscard]] bool fits_grid(const IntOrigin& lowest_origin, const IntBox& bounds, const CoarseAxes& coarse,
                             int coord_bits);

/// "y 1, z 2"; "none".
[[nodiscard]] std::string to_text(const CoarseAxes& coarse);

}  // namespace hitpipe::ref
