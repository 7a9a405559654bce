#include "sim/fit/port_ranges.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "sw_ref/quantise/grid.hpp"
#include "sw_ref/quantise/int_box.hpp"

namespace hitpipe::sim {

namespace {

/// M a / b, rounded up to a whole number, plus 1 for the rounding of the double (M a / b < 2^31 after the
/// cut). The result is in 0..M.
std::int64_t scaled_up(double a, double b, std::int64_t limit) {
  const double quotient = static_cast<double>(limit) * a / b;
  if (!(quotient < static_cast<double>(limit))) return limit;  // also 0 / 0 and x / 0
  return std::min(limit, static_cast<std::int64_t>(std::ceil(quotient)) + 1);
}
std::int64_t scaled_down(double a, double b, std::int64_t limit) {
  if (a == 0.0) return 0;
  const double quotient = std::min(static_cast<double>(limit), static_cast<double>(limit) * a / b);
  return std::max<std::int64_t>(0, static_cast<std::int64_t>(std::floor(quotient)) - 1);
}

/// The directions of all families along the axis. Nothing if one may be 0 or if signs differ.
std::optional<ref::Aabb> one_sided(const ref::SceneDemands& scene, int axis) {
  ref::Aabb all;
  for (const ref::RayFamily& family : scene.rays) all.grow(family.direction);
  if (all.min[axis] > 0.0F || all.max[axis] < 0.0F) return all;
  return std::nullopt;
}

}  // namespace

Magnitudes::Magnitudes(const ref::Aabb& direction) {
  for (int axis = 0; axis < 3; ++axis) {
    const double low = direction.min[axis];
    const double high = direction.max[axis];
    const auto i = static_cast<std::size_t>(axis);
    most[i] = std::max(std::abs(low), std::abs(high));
    least[i] = low <= 0.0 && high >= 0.0 ? 0.0 : std::min(std::abs(low), std::abs(high));
  }
}

void grow(Range& range, const rtl::Interval& by) {
  range = range ? rtl::Interval{std::min(range->low, by.low), std::max(range->high, by.high)} : by;
}

Range int_origin(const ref::SceneDemands& scene, int axis, int coord_bits, const ref::CoarseAxes& coarse) {
  const ref::Aabb origins = scene.origins();
  const auto i = static_cast<std::size_t>(axis);
  const auto on_grid = [&](float at) {
    ref::IntOrigin origin{};
    origin[i] = static_cast<std::int32_t>(ref::grid_floor(at, coord_bits, ref::Half::up));
    return ref::coarse_origin(origin, coarse, coord_bits)[i];
  };
  return rtl::Interval{on_grid(origins.min[axis]), on_grid(origins.max[axis])};
}

Range int_box(const ref::SceneDemands& scene, int axis, int coord_bits, const ref::CoarseAxes& coarse) {
  const ref::IntBox box = ref::coarse_box(ref::quantise_box(scene.boxes, coord_bits), coarse, coord_bits);
  const auto i = static_cast<std::size_t>(axis);
  return rtl::Interval{box.min[i], box.max[i]};
}

std::optional<IrdvcRanges> int_irdvc(const ref::SceneDemands& scene, int axis, int coord_bits) {
  if (!one_sided(scene, axis)) return std::nullopt;
  const std::int64_t limit = ref::direction_limit(coord_bits);
  const auto i = static_cast<std::size_t>(axis);
  Range floors;
  Range ceils;
  for (const ref::RayFamily& family : scene.rays) {
    // c_i| = M s / |r_i|, where s is the magnitude of the smallest component. Its bounds are the whole
    // numbers on both sides.
    const Magnitudes r(family.direction);
    const double smallest_most = *std::min_element(r.most.begin(), r.most.end());
    const double smallest_least = *std::min_element(r.least.begin(), r.least.end());
    const std::int64_t most = scaled_up(smallest_most, r.least[i], limit);
    const std::int64_t least = scaled_down(smallest_least, r.most[i], limit);
    // The bound farther from 0 is at least 1 at any scale: see int_slabs_ray.cpp.
    const rtl::Interval outer{std::max<std::int64_t>(1, least), std::max<std::int64_t>(1, most)};
    const rtl::Interval inner{least, most};
    if (family.direction.min[axis] > 0.0F) {
      grow(floors, inner);
      grow(ceils, outer);
    } else {
      grow(floors, {-outer.high, -outer.low});
      grow(ceils, {-inner.high, -inner.low});
    }
  }
  return IrdvcRanges{*floors, *ceils};
}

Range int_direction(const ref::SceneDemands& scene, int axis, int coord_bits) {
  const std::int64_t limit = ref::direction_limit(coord_bits);
  Range range;
  for (const ref::RayFamily& family : scene.rays) {
    // M r_i / l, rounded to nearest, where l is the magnitude of the largest component.
    const Magnitudes r(family.direction);
    const double largest_most = *std::max_element(r.most.begin(), r.most.end());
    const double largest_least = *std::max_element(r.least.begin(), r.least.end());
    const double low = family.direction.min[axis];
    const double high = family.direction.max[axis];
    grow(range,
         {low < 0.0 ? -scaled_up(-low, largest_least, limit) : scaled_down(low, largest_most, limit),
          high > 0.0 ? scaled_up(high, largest_least, limit) : -scaled_down(-high, largest_most, limit)});
  }
  return range;
}

Range float_range(float low, float high) {
  const auto pattern = [](float x) { return std::int64_t{std::bit_cast<std::uint32_t>(x)}; };
  if (std::bit_cast<std::uint32_t>(low) == std::bit_cast<std::uint32_t>(high))
    return rtl::Interval{pattern(low), pattern(low)};
  if (low > 0.0F) return rtl::Interval{pattern(low), pattern(high)};
  if (high < 0.0F) return rtl::Interval{pattern(high), pattern(low)};
  return std::nullopt;
}

Range float_direction(const ref::SceneDemands& scene, int axis) {
  const auto all = one_sided(scene, axis);
  return all ? float_range(all->min[axis], all->max[axis]) : std::nullopt;
}

Range float_irdvc(const ref::SceneDemands& scene, int axis) {
  const auto all = one_sided(scene, axis);
  // Rounding is monotone, so the reciprocals of the ends bound all reciprocals between them.
  return all ? float_range(1.0F / all->max[axis], 1.0F / all->min[axis]) : std::nullopt;
}

}  // namespace hitpipe::sim
