#include "rays/world/int_major_ray.hpp"

#include <bit>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "rays/exact/binary32.hpp"
#include "rays/exact/grid.hpp"
#include "rays/world/ray_check.hpp"

namespace hitpipe::ref {

// Why the unit never misses is in docs/never_misses.md. What its proof takes from this file:
//   origin     r is nearest to o = G 2^g origin. In the mirrored world, where directions are positive, a tie
//              goes down: o - 1/2 <= r < o + 1/2.
//   quotient   the bounds of MajorQuotient; with the largest exponent and mantissas, |D_M| / |D_k| is greater
//              than (2 - 2^(1-p)) 2^(n+g-1).
//   length     rounded down.

namespace {

constexpr std::string_view major_set_up = "IntMajorRaySetup";

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

MajorQuotient quotient(float major, float other, const hls::MajorBits& bits) {
  if (other == 0.0F) return largest_quotient(bits);
  const Normal above = normal(major);
  const Normal below = normal(other);
  return quotient_bounds(above.mantissa, below.mantissa, above.exponent - below.exponent, bits);
}

}  // namespace

IntMajorRaySetup::IntMajorRaySetup(const Ray& ray, hls::MajorBits bits) : bits_(bits) {
  if (!bits.proved() || bits.slope > 0)
    throw std::invalid_argument(fmt::format("{}: there is no format {}+{}/{}f{}{}", major_set_up, bits.coord,
                                            bits.finer, bits.mantissa, bits.fraction,
                                            bits.slope > 0 ? " of the float world" : ""));
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
  return length_along_major(length, major_, bits_.coord, bits_.fraction, bits_.largest_length());
}

}  // namespace hitpipe::ref
