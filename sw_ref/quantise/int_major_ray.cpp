#include "sw_ref/quantise/int_major_ray.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "sw_ref/judge/binary32.hpp"
#include "sw_ref/quantise/grid.hpp"
#include "sw_ref/quantise/ray_check.hpp"

namespace hitpipe::ref {

// Why the unit never misses is in docs/major.md. What its proof takes from this file:
//   origin     r is nearest to o = G 2^g origin. In the mirrored world, where directions are positive, a tie
//              goes down: o - 1/2 <= r < o + 1/2.
//   quotient   the bounds of MajorQuotient; with the largest exponent and mantissas, |D_M| / |D_k| is greater
//              than (2 - 2^(1-p)) 2^(n+g-1).
//   length     rounded down.

namespace {

constexpr std::string_view major_set_up = "IntMajorRaySetup";
__extension__ typedef unsigned __int128 Uint128;

/// A positive binary32 as m 2^e with m in 2^23..2^24-1.
struct Normal {
  std::uint64_t mantissa;
  int exponent;
};

Normal normal(float x) {
  const Binary32 parts = decode(x);
  const int spare = std::countl_zero(parts.mantissa) - 8;
  return {std::uint64_t{parts.mantissa} << spare, parts.exponent - spare};
}

/// The smallest exponent for which the upper mantissa fits p bits.
MajorQuotient quotient(float major, float other, const hls::MajorBits& bits) {
  const auto largest = static_cast<std::uint32_t>(bits.largest_mantissa());
  const MajorQuotient too_large{largest, largest, bits.largest_exponent()};
  if (other == 0.0F) return too_large;
  const Normal above = normal(major);
  const Normal below = normal(other);
  // |D_M| / |D_k| = q 2^exponent with q in [1, 2).
  const int halved = above.mantissa < below.mantissa ? 1 : 0;
  const int exponent = above.exponent - below.exponent - halved;
  if (exponent > bits.largest_exponent()) return too_large;
  const std::uint64_t numerator = above.mantissa << (bits.mantissa - 1 + halved);  // < 2^56
  const auto low = static_cast<std::uint32_t>(numerator / below.mantissa);
  const bool exact = numerator % below.mantissa == 0;
  if (exact) return {low, low, exponent};
  if (low < largest) return {low, low + 1, exponent};
  // The upper bound would be 2: half of it, with the next exponent.
  if (exponent == bits.largest_exponent()) return too_large;
  return {largest >> 1, (largest >> 1) + 1, exponent + 1};
}

int major_axis(const glm::vec3& direction) {
  int major = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(direction[axis]) > std::abs(direction[major])) major = axis;
  return major;
}

}  // namespace

IntMajorRaySetup::IntMajorRaySetup(const Ray& ray, hls::MajorBits bits) : bits_(bits) {
  if (!bits.proved())
    throw std::invalid_argument(fmt::format("{}: there is no format {}+{}/{}f{}", major_set_up, bits.coord,
                                            bits.finer, bits.mantissa, bits.fraction));
  check_ray(ray, major_set_up);
  const int major = major_axis(ray.direction);
  ray_.axes = {0, 1, 2};
  std::swap(ray_.axes[0], ray_.axes[static_cast<std::size_t>(major)]);
  major_ = std::abs(ray.direction[major]);
  for (std::size_t ray_axis = 0; ray_axis < 3; ++ray_axis) {
    const int axis = ray_.axes[ray_axis];
    const float component = ray.direction[axis];
    const float origin = ray.origin[axis];
    ray_.backward[ray_axis] = component < 0.0F;
    ray_.origin[ray_axis] = ray_.backward[ray_axis] ? -fine_nearest(origin, bits.coord, bits.finer) - 1
                                                    : -fine_nearest(-origin, bits.coord, bits.finer);
    if (ray_axis > 0) ray_.quotient[ray_axis - 1] = quotient(major_, std::abs(component), bits);
  }
}

std::int64_t IntMajorRaySetup::length(float length) const {
  check_length(length, major_set_up);
  const std::int64_t largest = bits_.largest_length();
  if (std::isinf(length)) return largest;
  const Binary32 distance = decode(length);
  const Binary32 major = decode(major_);
  const Uint128 product = static_cast<Uint128>(static_cast<std::uint64_t>(grid_scale(bits_.coord))) *
                          distance.mantissa * major.mantissa;  // < 2^78
  const int exponent = distance.exponent + major.exponent + bits_.fraction;
  if (product == 0 || exponent <= -128) return 0;
  // From 2^40 on anything is larger than the largest length, which is below 2^35.
  if (exponent >= 40) return largest;
  const Uint128 full = exponent < 0 ? product >> -exponent : product << exponent;
  return static_cast<std::int64_t>(std::min(full, static_cast<Uint128>(largest)));
}

}  // namespace hitpipe::ref
