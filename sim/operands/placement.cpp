#include "sim/operands/placement.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/quantise/to_cube.hpp"

namespace hitpipe::sim {

namespace {

// Products of these with a scale neither overflow nor lose bits in a double.
constexpr double largest_number = 1e30;
constexpr double smallest_side = 1e-30;

void check(const ref::Bounds& bounds) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double bound : {bounds.min[axis], bounds.max[axis]})
      if (!(std::abs(bound) <= largest_number))
        throw std::runtime_error(fmt::format("bounds: {} is out of range; allowed is -1e30 to 1e30", bound));
    if (bounds.min[axis] > bounds.max[axis])
      throw std::runtime_error(fmt::format("bounds: min_{0} {1} is above max_{0} {2}", "xyz"[axis],
                                           bounds.min[axis], bounds.max[axis]));
  }
  if (!(bounds.longest() >= smallest_side))
    throw std::runtime_error(
        fmt::format("bounds: the longest side is {}; it must be at least 1e-30", bounds.longest()));
}

}  // namespace

Placement::Placement(const ref::Bounds& bounds) : has_bounds_(true) {
  check(bounds);
  transform_ = ref::fit_to_cube(bounds, {});
}

double Placement::place(double own, int axis) const {
  return has_bounds_ ? (own - transform_.offset[axis]) * transform_.scale : own;
}

float Placement::plane(double own, int axis, Rounding side) const {
  if (!has_bounds_) return to_binary32(own, 0.0, side);
  const double offset = transform_.offset[axis];
  return side == Rounding::up ? ref::plane_above(own, offset, transform_.scale)
                              : ref::plane_below(own, offset, transform_.scale);
}

}  // namespace hitpipe::sim
