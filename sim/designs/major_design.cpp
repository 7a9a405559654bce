#include "sim/designs/major_design.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/exact/grid.hpp"
#include "rays/world/int_meets.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/ray_check.hpp"
#include "sim/designs/port_ranges.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sw_ref/judge/adversary/categories.hpp"

namespace hitpipe::sim {

namespace {

using hls::MajorBits;

/// The world of a box format: box distances do not depend on the F of T.
hls::WorldBits world_of(const MajorBits& bits) {
  return {bits.coord, bits.finer, bits.slope, 0};
}

/// From few bits to many, and around the default.
std::vector<Format> major_sweep_formats() {
  return {MajorBits{12, 1, 9},  MajorBits{16, 1, 11}, MajorBits{18, 1, 12}, MajorBits{20, 0, 13},
          MajorBits{20, 1, 11}, MajorBits{20, 1, 13}, MajorBits{20, 2, 13}, MajorBits{24, 1, 16}};
}

/// n from the least on, each with g = 0 .. most and every mantissa up to the most.
std::vector<std::vector<Format>> major_smaller_formats(const Format& most) {
  const auto bits = most.as<MajorBits>();
  std::vector<std::vector<Format>> groups;
  for (int n = MajorBits::min_coord; n <= bits.coord; ++n) {
    for (int finer = 0; finer <= bits.finer; ++finer) {
      std::vector<Format>& group = groups.emplace_back();
      for (int mantissa = MajorBits::min_mantissa; mantissa <= bits.mantissa; ++mantissa)
        if (const MajorBits each{n, finer, mantissa, bits.fraction}; each.valid()) group.push_back(each);
      if (group.empty()) groups.pop_back();
    }
  }
  return groups;
}

/// A family of rays whose major axis is axes[0]; axes[i] is the axis that is ray axis m, a or b.
struct TurnedFamily {
  const ref::RayFamily* family;
  Magnitudes direction;
  std::array<int, 3> axes;
};

/// Every family with every axis that can be its major one.
std::vector<TurnedFamily> turned_families(const ref::SceneDemands& scene) {
  std::vector<TurnedFamily> all;
  for (const ref::RayFamily& family : scene.rays) {
    const Magnitudes direction(family.direction);
    const double largest = *std::max_element(direction.least.begin(), direction.least.end());
    for (std::size_t major = 0; major < 3; ++major) {
      if (direction.most[major] < largest) continue;
      TurnedFamily each{&family, direction, {0, 1, 2}};
      std::swap(each.axes[0], each.axes[major]);
      all.push_back(each);
    }
  }
  return all;
}

rtl::Interval origins(const TurnedFamily& ray, std::size_t ray_axis, const MajorBits& bits) {
  const int axis = ray.axes[ray_axis];
  const auto rounded = [&](float x) { return ref::fine_nearest(x, bits.coord, bits.finer); };
  const float low = ray.family->origin.min[axis];
  const float high = ray.family->origin.max[axis];
  Range range;
  if (ray.family->direction.max[axis] >= 0.0F) grow(range, {-rounded(-low), -rounded(-high)});
  if (ray.family->direction.min[axis] < 0.0F) grow(range, {-rounded(high) - 1, -rounded(low) - 1});
  return *range;
}

/// The margin is for the rounding of the quotient.
rtl::Interval exponents(const TurnedFamily& ray, std::size_t ray_axis, const MajorBits& bits) {
  constexpr double margin = 1e-12;
  const auto major = static_cast<std::size_t>(ray.axes[0]);
  const auto other = static_cast<std::size_t>(ray.axes[ray_axis]);
  const auto& [least, most] = ray.direction;
  const int cap = bits.largest_exponent();
  const auto power = [&](double above, double below) {
    const double quotient = above / below;
    if (below == 0.0 || quotient > std::ldexp(1.0, cap)) return cap;
    return std::ilogb(std::max(1.0, quotient));
  };
  // An upper mantissa that would be 2 takes the next exponent.
  return {power(least[major] * (1.0 - margin), most[other]),
          std::min(cap, power(most[major] * (1.0 + margin), least[other]) + 1)};
}

/// The ray axis that a port of the ray belongs to: 0 is m, 1 is a, 2 is b.
std::size_t ray_axis_of(const rtl::Port& port, const MajorBits& bits) {
  using Ray = hls::MajorRay<Words, MajorBits>;
  Ray ray_axes{};
  ray_axes.back_a = ray_axes.origin_a = ray_axes.floor_a = ray_axes.ceil_a = ray_axes.exp_a = 1;
  ray_axes.back_b = ray_axes.origin_b = ray_axes.floor_b = ray_axes.ceil_b = ray_axes.exp_b = 2;
  std::int64_t found = 0;
  Ray::for_each(bits, ray_axes, [&](const hls::Operand& operand, std::int64_t ray_axis) {
    if (port.name == operand.name) found = ray_axis;
  });
  return static_cast<std::size_t>(found);
}

std::optional<SceneDemand> major_demand(const rtl::Port& port, const Format& format,
                                        const ref::SceneDemands& scene, const ref::CoarseAxes& /*none*/) {
  // The margin of the cube leaves one bit of every coordinate unused, in every scene.
  constexpr int spare = 1;
  const auto bits = format.as<MajorBits>();
  if (port.role == hls::Role::plane_low || port.role == hls::Role::plane_high) {
    const ref::IntBox box = ref::quantise_box(scene.boxes, bits.coord, bits.finer);
    const auto axis = static_cast<std::size_t>(rtl::axis_of(port));
    return SceneDemand{{{box.min[axis], box.max[axis]}}, spare};
  }
  const auto range_of = [&](const TurnedFamily& ray) -> Range {
    const std::size_t ray_axis = ray_axis_of(port, bits);
    const int axis = ray.axes[ray_axis];
    switch (port.role) {
      case hls::Role::origin:
        return origins(ray, ray_axis, bits);
      case hls::Role::exponent:
        return exponents(ray, ray_axis, bits);
      case hls::Role::backward:
        return rtl::Interval{ray.family->direction.max[axis] < 0.0F ? 1 : 0,
                             ray.family->direction.min[axis] < 0.0F ? 1 : 0};
      case hls::Role::major: {
        const bool is = ray.axes[0] == rtl::axis_of(port);
        return rtl::Interval{is ? 1 : 0, is ? 1 : 0};
      }
      default:
        return std::nullopt;
    }
  };
  Range range;
  for (const TurnedFamily& ray : turned_families(scene)) {
    const Range one = range_of(ray);
    if (!one) return std::nullopt;
    grow(range, *one);
  }
  if (!range) return std::nullopt;
  return SceneDemand{{*range}, port.role == hls::Role::origin ? spare : 0};
}

}  // namespace

void put_major_ray(const ref::IntMajorRay& ray, hls::MajorRay<Words, MajorBits>& in) {
  in.major_y = ray.axes[0] == 1 ? 1 : 0;
  in.major_z = ray.axes[0] == 2 ? 1 : 0;
  put(ray.backward, in.back_m, in.back_a, in.back_b);
  put(ray.origin, in.origin_m, in.origin_a, in.origin_b);
  const auto& [a, b] = ray.quotient;
  in.floor_a = a.mantissa_low;
  in.ceil_a = a.mantissa_high;
  in.exp_a = a.exponent;
  in.floor_b = b.mantissa_low;
  in.ceil_b = b.mantissa_high;
  in.exp_b = b.exponent;
}

MajorSetup::MajorSetup(const ref::Ray& ray, const MajorBits& bits)
    : bits_(bits),
      major_(std::abs(ray.direction[ref::major_axis(ray.direction)])),
      ray_(bits.slope > 0 ? ref::major_ray(ref::int_ray(ray, world_of(bits)), bits)
                          : ref::IntMajorRaySetup(ray, bits).ray()) {}

std::int64_t MajorSetup::length(float length) const {
  ref::check_length(length, "MajorSetup");
  return ref::length_along_major(length, major_, bits_.coord, bits_.fraction, bits_.largest_length());
}

void major_boxes(std::span<const ref::Aabb> boxes, const Format& format, std::span<ref::IntBox> out) {
  const auto bits = format.as<MajorBits>();
  if (bits.slope == 0) {
    ref::quantise_boxes(boxes, bits.coord, out, bits.finer);
    return;
  }
  const auto nearest = [&](float x) { return static_cast<std::int32_t>(ref::fine_nearest(x, bits.coord)); };
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (int axis = 0; axis < 3; ++axis) {
      out[i].min[static_cast<std::size_t>(axis)] = nearest(boxes[i].min[axis]);
      out[i].max[static_cast<std::size_t>(axis)] = nearest(boxes[i].max[axis]);
    }
  }
}

bool integer_meet(const ref::Ray& ray, std::span<const ref::Aabb> boxes, const Format& format,
                  std::span<bool> out) {
  const auto bits = format.as<MajorBits>();
  if (bits.slope == 0) return false;
  const hls::WorldBits world = world_of(bits);
  const ref::IntRay own = ref::int_ray(ray, world);
  std::vector<ref::IntBox> rounded(boxes.size());
  major_boxes(boxes, format, rounded);
  for (std::size_t i = 0; i < boxes.size(); ++i) out[i] = ref::int_meets(own, rounded[i], own.length, world);
  return true;
}

MajorBits float_world(const Format& format) {
  const auto bits = format.as<MajorBits>();
  if (bits.slope > 0)
    throw std::runtime_error(fmt::format(
        "bits {}: a scene of floats cannot be traced in a format of the integer world, which has s",
        to_string(format)));
  return bits;
}

namespace {

/// In the integer world the slopes are quotients too, and mantissas are of the slopes.
area::Divisions major_divisions(const Format& format) {
  const auto bits = format.as<hls::MajorBits>();
  return {.count = bits.slope > 0 ? 4 : 2, .quotient_bits = std::max(bits.mantissa, bits.slope)};
}

}  // namespace

Software major_design_software() {
  const auto own = ref::adversary::major_categories();
  return {.divisions = major_divisions,
          .demand = major_demand,
          .smaller_formats = major_smaller_formats,
          .sweep_formats = major_sweep_formats(),
          .stiffness_formats = {MajorBits{20, 1, 13}, MajorBits{16, 1, 12}},
          .fit_from = MajorBits{},
          .categories = {own.begin(), own.end()}};
}

}  // namespace hitpipe::sim
