#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "sw_ref/exact/binary32.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/ray_check.hpp"

namespace hitpipe::ref {

// Why the unit never misses is in docs/conservative.md. What its proof takes from this file, with d the
// direction and s = scale_:
//   origin    origin_low <= +-o <= origin_high
//   inverse   inverse_low <= 2^s / |d| and (1 + 2^-M) 2^s / |d| <= inverse_high; both are infinite for d = 0
//   length    rounded down, or endless

namespace {

constexpr std::string_view safe_set_up = "FpSlabsSafeRaySetup";

/// A positive binary32 as 2^exponent m / 2^24 with m in 2^23 + 1 .. 2^24.
struct UpToPower {
  std::uint64_t mantissa;
  int exponent;
};

UpToPower up_to_power(float x) {
  const Binary32 parts = decode(x);
  const int spare = std::countl_zero(parts.mantissa) - 8;
  const UpToPower normal{std::uint64_t{parts.mantissa} << spare, parts.exponent - spare + 24};
  const bool is_power = normal.mantissa == 1U << 23;
  return is_power ? UpToPower{1U << 24, normal.exponent - 1} : normal;
}

/// The pattern of units 2^(exponent - M) with units in 2^M .. 2^(M+1).
std::int64_t pattern_of(std::uint64_t units, int exponent, const hls::AnyFpBits& bits) {
  // The implicit one adds 1 to the exponent field; so does a carry.
  return (std::int64_t{exponent + bits.bias() - 1} << bits.fraction) + static_cast<std::int64_t>(units);
}

}  // namespace

FpSlabsSafeRaySetup::FpSlabsSafeRaySetup(const Ray& ray, const hls::AnyFpBits& bits) : bits_(bits) {
  const FpRounding rounding(bits);
  check_ray(ray, safe_set_up);
  const glm::vec3& d = ray.direction;
  scale_ = up_to_power(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)})).exponent;
  const std::uint64_t one = std::uint64_t{1} << bits.fraction;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    ray_.back[i] = std::signbit(d[axis]);
    const float origin = ray_.back[i] ? -ray.origin[axis] : ray.origin[axis];
    ray_.origin_low[i] = rounding.down(origin);
    ray_.origin_high[i] = rounding.up(origin);
    ray_.inverse_low[i] = ray_.inverse_high[i] = bits.infinity();
    if (d[axis] == 0.0F) continue;
    // 2^s / |d| = 2^exponent 2^24 / m, and 2^24 / m is in [1, 2).
    const UpToPower size = up_to_power(std::abs(d[axis]));
    const int exponent = scale_ - size.exponent;
    if (exponent > bits.bias()) {
      ray_.inverse_low[i] = bits.infinity() - 1;
      continue;
    }
    ray_.inverse_low[i] = pattern_of((one << 24) / size.mantissa, exponent, bits);
    const std::uint64_t high = (((one + 1) << 24) + size.mantissa - 1) / size.mantissa;
    const bool carries = high > 2 * one;
    ray_.inverse_high[i] = std::min(bits.infinity(), carries ? pattern_of((high + 1) / 2, exponent + 1, bits)
                                                             : pattern_of(high, exponent, bits));
  }
}

FpSlabsSafeEnd FpSlabsSafeRaySetup::end(float length) const {
  check_length(length, safe_set_up);
  const FpSlabsSafeEnd endless{bits_.infinity(), true};
  if (std::isinf(length)) return endless;
  const Binary32 parts = decode(length);
  if (parts.mantissa == 0) return {};
  const int exponent = parts.exponent + scale_;
  const int highest = exponent + static_cast<int>(std::bit_width(parts.mantissa)) - 1;
  if (highest > bits_.bias()) return endless;
  const int power = std::max(highest, 1 - bits_.bias());  // that of the highest bit of a normal number
  const int below = power - bits_.fraction - exponent;    // bits of the mantissa below the last place
  const std::uint64_t mantissa = parts.mantissa;
  const std::uint64_t units = below >= 64 ? 0 : below >= 0 ? mantissa >> below : mantissa << -below;
  return {pattern_of(units, power, bits_), false};
}

}  // namespace hitpipe::ref
