#include "sw_ref/quantise/int_box.hpp"

#include <cmath>
#include <cstring>
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
std::int64_t lower(float x, int coord_bits) {
  return grid_floor(x, coord_bits, Half::down);
}
std::int64_t upper(float x, int coord_bits) {
  return -grid_floor(-x, coord_bits, Half::down);  // ceil(y) = -floor(-y): one rounding for both corners
}

/// Four of a box's planes, numbered as Aabb::plane does: what is done to all of a vector vectorises.
using Planes = std::array<float, 4>;

Planes planes_from(const Aabb& box, std::size_t first) {
  Planes planes;
  std::memcpy(planes.data(), reinterpret_cast<const std::byte*>(&box) + sizeof(float) * first, sizeof planes);
  return planes;
}

bool within_cube(const Planes& a, const Planes& b) {
  int beyond = 0;  // a NaN is
  for (std::size_t i = 0; i < 4; ++i) {
    beyond |= (std::abs(a[i]) <= 1.0F ? 0 : 1) | (std::abs(b[i]) <= 1.0F ? 0 : 1);
  }
  return beyond == 0;
}

/// floor(scale * plane - 1/2).
std::array<std::int32_t, 4> rounded_down(const Planes& planes, double scale) {
  std::array<std::int32_t, 4> rounded{};
  for (std::size_t i = 0; i < 4; ++i) {
    rounded[i] = static_cast<std::int32_t>(grid_nearest(planes[i], scale) - 1.0);
  }
  return rounded;
}

/// Beyond |x| = 1 a coordinate may leave the grid.
std::int32_t checked(std::int64_t (*corner)(float, int), float x, int coord_bits, int axis) {
  if (std::abs(x) <= 2.0F) {
    const std::int64_t coordinate = corner(x, coord_bits);
    if (std::abs(coordinate) <= grid_limit(coord_bits)) return static_cast<std::int32_t>(coordinate);
  }
  throw std::out_of_range(
      fmt::format("quantise_box: {}.{} = {} leaves the {}-bit grid; boxes must lie within [-1, 1]",
                  corner == upper ? "max" : "min", "xyz"[axis], x, coord_bits));
}

}  // namespace

IntBox quantise_box(const Aabb& box, int coord_bits) {
  if (coord_bits < hls::IntBits::min_coord || coord_bits > hls::IntBits::max_coord) {
    throw std::invalid_argument(fmt::format("quantise_box: {} coordinate bits; allowed are {} to {}",
                                            coord_bits, hls::IntBits::min_coord, hls::IntBits::max_coord));
  }
  const Planes with_min = planes_from(box, 0);
  const Planes with_max = planes_from(box, 2);
  if (coord_bits <= exact_in_double && within_cube(with_min, with_max)) {
    const auto scale = static_cast<double>(grid_scale(coord_bits));
    const auto min = rounded_down(with_min, scale);
    const auto max = rounded_down(with_max, -scale);
    return {{min[0], min[1], min[2]}, {-max[1], -max[2], -max[3]}};
  }
  IntBox result;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    result.min[i] = checked(lower, box.min[axis], coord_bits, axis);
    result.max[i] = checked(upper, box.max[axis], coord_bits, axis);
  }
  return result;
}

}  // namespace hitpipe::ref
