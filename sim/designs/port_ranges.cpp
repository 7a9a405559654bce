#include "sim/designs/port_ranges.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "rays/exact/grid.hpp"
#include "rays/world/int_box.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/fp_inverse.hpp"

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
    origin[i] = static_cast<std::int32_t>(ref::fine_nearest(at, coord_bits));
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

namespace {

bool same_bits(float a, float b) {
  return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

/// Which signs the family's directions have along the axis. A zero may have either sign, unless all
/// directions are one.
struct Signs {
  bool positive, negative;

  Signs(const ref::RayFamily& family, int axis) {
    const float low = family.direction.min[axis];
    const float high = family.direction.max[axis];
    const bool one = same_bits(low, high);
    negative = one ? std::signbit(low) : low <= 0.0F;
    positive = one ? !std::signbit(low) : high >= 0.0F;
  }
};

}  // namespace

void FloatRange::add(float low, float high) {
  const std::int64_t sign = std::int64_t{1} << (bits_.width() - 1);
  const auto pattern = [&](float x) { return ref::fp_pattern(x, bits_); };
  if (!std::signbit(high)) grow(positive_, {std::signbit(low) ? 0 : pattern(low), pattern(high)});
  if (std::signbit(low)) grow(negative_, {std::signbit(high) ? pattern(high) : sign, pattern(low)});
}

std::vector<rtl::Interval> FloatRange::within() const {
  std::vector<rtl::Interval> all;
  for (const Range& range : {positive_, negative_})
    if (range) all.push_back(*range);
  return all;
}

std::vector<rtl::Interval> mirrored_origin(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits,
                                           bool low) {
  const ref::FpRounding rounding(bits);
  FloatRange range(bits);
  const auto add = [&](float from, float to) {
    range.add(low ? rounding.down(from) : rounding.up(from), low ? rounding.down(to) : rounding.up(to));
  };
  for (const ref::RayFamily& family : scene.rays) {
    float from = family.origin.min[axis];
    float to = family.origin.max[axis];
    if (!same_bits(from, to)) {  // a zero at an end may have either sign
      from = from == 0.0F ? -0.0F : from;
      to = to == 0.0F ? 0.0F : to;
    }
    const Signs signs(family, axis);
    if (signs.positive) add(from, to);
    if (signs.negative) add(-to, -from);
  }
  return range.within();
}

std::vector<rtl::Interval> rounded_planes(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits,
                                          bool low) {
  const ref::FpRounding rounding(bits);
  const auto rounded = [&](const glm::vec3& at) {
    const ref::Aabb plane = rounding.outward({at, at});
    return (low ? plane.min : plane.max)[axis];
  };
  FloatRange range(bits);
  range.add(rounded(scene.boxes.min), rounded(scene.boxes.max));
  return range.within();
}

rtl::Interval scaled_inverse(const ref::SceneDemands& scene, int axis, const hls::FpBits& bits, bool low) {
  const auto bound = [&](const ref::FpInverse& inverse) { return low ? inverse.low : inverse.high; };
  const auto i = static_cast<std::size_t>(axis);
  Range range;
  for (const ref::RayFamily& family : scene.rays) {
    const Magnitudes d(family.direction);
    const auto scale_of = [](const std::array<double, 3>& sizes) {
      return ref::up_to_power(static_cast<float>(*std::max_element(sizes.begin(), sizes.end()))).exponent;
    };
    const std::int64_t most = bound(ref::fp_inverse(scale_of(d.most), static_cast<float>(d.least[i]), bits));
    std::int64_t least = bits.one();
    if (*std::max_element(d.least.begin(), d.least.end()) > 0.0) {
      const int scale = scale_of(d.least);
      const double size = std::min(d.most[i], std::ldexp(1.0, scale));  // no component exceeds its scale
      least = bound(ref::fp_inverse(scale, static_cast<float>(size), bits));
    }
    grow(range, {least, most});
  }
  return *range;
}

rtl::Interval backward(const ref::SceneDemands& scene, int axis) {
  bool ever = false;
  bool always = true;
  for (const ref::RayFamily& family : scene.rays) {
    const Signs signs(family, axis);
    ever = ever || signs.negative;
    always = always && !signs.positive;
  }
  return {always ? 1 : 0, ever ? 1 : 0};
}

}  // namespace hitpipe::sim
