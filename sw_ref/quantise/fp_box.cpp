#include "sw_ref/quantise/fp_box.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

namespace hitpipe::ref {
namespace {

void check_within_cube(const Aabb& box) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const float x : {box.min[axis], box.max[axis]}) {
      if (!(std::abs(x) <= 1.0F))
        throw std::out_of_range(
            fmt::format("round_box: {} = {}; boxes must lie within [-1, 1]", "xyz"[axis], x));
    }
  }
}

}  // namespace

FpRounding::FpRounding(const hls::FpBits& bits) {
  if (!bits.valid())
    throw std::invalid_argument(fmt::format("there is no float format e{}m{}", bits.exponent, bits.fraction));
  const int least = 1 - bits.bias();
  least_normal_ = std::ldexp(1.0, least);
  subnormal_unit_ = std::ldexp(1.0, least - bits.fraction);
  in_subnormal_units_ = std::ldexp(1.0, bits.fraction - least);
  cut_ = 23 - bits.fraction;
}

float FpRounding::down(float x) const {
  if (std::abs(x) < least_normal_)  // the product is exact, and so is the quotient
    return static_cast<float>(std::floor(x * in_subnormal_units_) * subnormal_unit_);
  // A carry out of the fraction goes to the exponent.
  const auto bits = std::bit_cast<std::uint32_t>(x);
  const std::uint32_t low = (1U << cut_) - 1;
  return std::bit_cast<float>((std::signbit(x) ? bits + low : bits) & ~low);
}

Aabb FpRounding::outward(const Aabb& box) const {
  Aabb rounded;
  for (int axis = 0; axis < 3; ++axis) {
    const float min = down(box.min[axis]);
    const float max = up(box.max[axis]);
    rounded.min[axis] = min == 0.0F ? -0.0F : min;
    rounded.max[axis] = max == 0.0F ? 0.0F : max;
  }
  return rounded;
}

std::int64_t fp_pattern(float x, const hls::FpBits& bits) {
  const auto own = std::bit_cast<std::uint32_t>(x);
  const int cut = 23 - bits.fraction;
  if (bits.exponent == 8) return own >> cut;
  const std::int64_t sign = std::int64_t{own >> 31} << (bits.width() - 1);
  const auto size = static_cast<std::int64_t>((own & 0x7FFFFFFFU) >> cut);
  const std::int64_t least_normal = std::int64_t{128 - bits.bias()} << bits.fraction;
  if (size >= least_normal) return sign | (size - least_normal + (std::int64_t{1} << bits.fraction));
  return sign | static_cast<std::int64_t>(std::ldexp(std::abs(x), bits.fraction + bits.bias() - 1));
}

double fp_number(std::int64_t magnitude, const hls::FpBits& bits) {
  if (magnitude >= bits.infinity()) return std::numeric_limits<double>::infinity();
  const auto field = static_cast<int>(magnitude >> bits.fraction);
  const std::int64_t implicit = std::int64_t{1} << bits.fraction;
  const std::int64_t fraction = magnitude & (implicit - 1);
  const std::int64_t significand = field == 0 ? fraction : implicit + fraction;
  return std::ldexp(static_cast<double>(significand), std::max(field, 1) - bits.bias() - bits.fraction);
}

Aabb round_box(const Aabb& box, const hls::FpBits& bits) {
  const FpRounding rounding(bits);
  check_within_cube(box);
  return rounding.outward(box);
}

}  // namespace hitpipe::ref
