#include "sw_ref/quantise/int_box.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/box/int_format.hpp"
#include "sw_ref/quantise/grid.hpp"

namespace hitpipe::ref {
namespace {

// Range. For |x| <= 1, whatever n: G |x| + 1/2 <= G + 1/2, so the outward rounded coordinate is at most
// G + 1 = 2^(n-2) in magnitude. A scene inside +-(1 - 2^-10) keeps its boxes below 1 - 2^-10 + 5e-7 < 1 when
// padded (section 4.3), so they always pass. Ray origins lie in [-G, G], so a difference is at most 2^(n-2) +
// G = 2^(n-1) - 1: it fits n bits.
enum class Corner { min, max };

std::int32_t outward(float x, int coord_bits, Corner corner, int axis) {
  if (std::abs(x) <= 2.0F) {
    // ceil(y) = -floor(-y) serves both corners with one rounding.
    const std::int64_t coordinate = corner == Corner::max ? -grid_floor(-x, coord_bits, Half::down)  //
                                                          : grid_floor(x, coord_bits, Half::down);
    if (std::abs(coordinate) <= grid_limit(coord_bits)) {
      return static_cast<std::int32_t>(coordinate);
    }
  }
  throw std::out_of_range(
      fmt::format("quantise_box: {}.{} = {} leaves the {}-bit grid; boxes must lie within [-1, 1]",
                  corner == Corner::max ? "max" : "min", "xyz"[axis], x, coord_bits));
}

}  // namespace

IntBox quantise_box(const Aabb& box, int coord_bits) {
  if (coord_bits < hls::IntBits::min_coord || coord_bits > hls::IntBits::max_coord) {
    throw std::invalid_argument(fmt::format("quantise_box: {} coordinate bits; allowed are {} to {}",
                                            coord_bits, hls::IntBits::min_coord, hls::IntBits::max_coord));
  }
  IntBox result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    result.min[i] = outward(box.min[axis], coord_bits, Corner::min, axis);
    result.max[i] = outward(box.max[axis], coord_bits, Corner::max, axis);
  }
  return result;
}

}  // namespace hitpipe::ref
