#include "sw_ref/quantise/fp_slabs_safe_ray.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "rays/exact/binary32.hpp"
#include "rays/world/ray_check.hpp"
#include "sw_ref/quantise/fp_box.hpp"
#include "sw_ref/quantise/fp_inverse.hpp"

namespace hitpipe::ref {

// Why the unit never misses is in docs/never_misses.md. What its proof takes from this file, with d the
// direction and s = scale_:
//   origin    origin_low <= +-o <= origin_high
//   inverse   inverse_low <= 2^s / |d| and (1 + 2^-M) 2^s / |d| <= inverse_high; both are infinite for d = 0
//   length    rounded down, or endless

namespace {

constexpr std::string_view safe_set_up = "FpSlabsSafeRaySetup";

}  // namespace

FpSlabsSafeRaySetup::FpSlabsSafeRaySetup(const Ray& ray, const hls::FpBits& bits) : bits_(bits) {
  const FpRounding rounding(bits);
  check_ray(ray, safe_set_up);
  const glm::vec3& d = ray.direction;
  scale_ = up_to_power(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)})).exponent;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    ray_.back[i] = std::signbit(d[axis]);
    const float origin = ray_.back[i] ? -ray.origin[axis] : ray.origin[axis];
    ray_.origin_low[i] = rounding.down(origin);
    ray_.origin_high[i] = rounding.up(origin);
    const FpInverse inverse = fp_inverse(scale_, std::abs(d[axis]), bits);
    ray_.inverse_low[i] = inverse.low;
    ray_.inverse_high[i] = inverse.high;
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
  const int power = std::max(highest, 1 - bits_.bias());  // of the highest bit of a normal number
  const int below = power - bits_.fraction - exponent;    // bits of the mantissa below the last place
  const std::uint64_t mantissa = parts.mantissa;
  const std::uint64_t units = below >= 64 ? 0 : below >= 0 ? mantissa >> below : mantissa << -below;
  return {fp_pattern_of(units, power, bits_), false};
}

}  // namespace hitpipe::ref
