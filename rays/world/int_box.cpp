#include "rays/world/int_box.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

#include <fmt/format.h>

#include "hls/box/int_format.hpp"
#include "rays/exact/grid.hpp"

namespace hitpipe::ref {
namespace {

// Range. For |x| <= 1 and every n, G |x| + 1/2 <= G + 1/2 (a finer grid of origins grows boxes less), so the
// outward rounded coordinate is at most G + 1 in magnitude. The padded boxes of a scene inside +-(1 - 2^-10)
// stay below 1 - 2^-10 + 5e-7 < 1 (section 4.3), so they always pass. Ray origins lie in [-G, G], so a
// difference is at most (G + 1) + G = M and fits n bits.
std::int64_t upper(float x, int coord_bits, int finer) {
  return -fine_lower(-x, coord_bits, finer);
}

static_assert(sizeof(Aabb) == 6 * sizeof(float) && sizeof(IntBox) == 6 * sizeof(std::int32_t),
              "boxes in a row are planes in a row");

constexpr std::size_t boxes_at_a_time = 16;
/// The planes of that many boxes, as they lie in memory. A loop that treats all planes alike vectorises.
template <class T>
using Planes = std::array<T, 6 * boxes_at_a_time>;

/// 1 for a lower plane, -1 for an upper one.
constexpr Planes<double> signs = [] {
  Planes<double> each{};
  for (std::size_t i = 0; i < each.size(); ++i) each[i] = i % 6 < 3 ? 1.0 : -1.0;
  return each;
}();

bool within_cube(const Planes<float>& planes, std::size_t count) {
  int beyond = 0;  // 1 also for a NaN
  for (std::size_t i = 0; i < count; ++i) beyond |= std::abs(planes[i]) <= 1.0F ? 0 : 1;
  return beyond == 0;
}

/// For planes in the cube and n <= exact_in_double. As ceil(y) = -floor(-y), one rounding serves both
/// corners.
void round_outward(const Planes<float>& planes, std::size_t count, int coord_bits,
                   Planes<std::int32_t>& rounded) {
  const auto unit = static_cast<double>(grid_scale(coord_bits));
  for (std::size_t i = 0; i < count; ++i) {
    rounded[i] = static_cast<std::int32_t>(signs[i] * (grid_nearest(planes[i], signs[i] * unit) - 1.0));
  }
}

/// Beyond |x| = 1 a coordinate may leave the grid.
std::int32_t checked(std::int64_t (*corner)(float, int, int), float x, int coord_bits, int finer, int axis) {
  if (std::abs(x) <= 2.0F) {
    const std::int64_t coordinate = corner(x, coord_bits, finer);
    if (std::abs(coordinate) <= grid_limit(coord_bits)) return static_cast<std::int32_t>(coordinate);
  }
  throw std::out_of_range(
      fmt::format("quantise_box: {}.{} = {} leaves the {}-bit grid; boxes must lie within [-1, 1]",
                  corner == upper ? "max" : "min", "xyz"[axis], x, coord_bits));
}

IntBox rounded_one_by_one(const Aabb& box, int coord_bits, int finer) {
  IntBox rounded;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    rounded.min[i] = checked(fine_lower, box.min[axis], coord_bits, finer, axis);
    rounded.max[i] = checked(upper, box.max[axis], coord_bits, finer, axis);
  }
  return rounded;
}

void check_bits(int coord_bits) {
  if (coord_bits < hls::IntBits::min_coord || coord_bits > hls::IntBits::max_coord) {
    throw std::invalid_argument(fmt::format("quantise_box: {} coordinate bits; allowed are {} to {}",
                                            coord_bits, hls::IntBits::min_coord, hls::IntBits::max_coord));
  }
}

}  // namespace

IntBox quantise_box(const Aabb& box, int coord_bits, int finer) {
  check_bits(coord_bits);
  return rounded_one_by_one(box, coord_bits, finer);
}

void quantise_boxes(std::span<const Aabb> boxes, int coord_bits, std::span<IntBox> out, int finer) {
  check_bits(coord_bits);
  Planes<float> planes;
  Planes<std::int32_t> rounded;
  for (std::size_t first = 0; first < boxes.size(); first += boxes_at_a_time) {
    const auto some = boxes.subspan(first, std::min(boxes_at_a_time, boxes.size() - first));
    std::memcpy(planes.data(), some.data(), some.size_bytes());
    const std::size_t count = 6 * some.size();
    if (finer == 0 && coord_bits <= exact_in_double && within_cube(planes, count)) {
      round_outward(planes, count, coord_bits, rounded);
      std::memcpy(static_cast<void*>(out.data() + first), rounded.data(), some.size() * sizeof(IntBox));
    } else {
      for (std::size_t i = 0; i < some.size(); ++i)
        out[first + i] = rounded_one_by_one(some[i], coord_bits, finer);
    }
  }
}

}  // namespace hitpipe::ref
