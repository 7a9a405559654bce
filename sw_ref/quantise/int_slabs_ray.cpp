#include "sw_ref/quantise/int_slabs_ray.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "rays/exact/binary32.hpp"
#include "rays/exact/grid.hpp"
#include "rays/world/ray_check.hpp"

namespace hitpipe::ref {

// Why the integer test never misses. G and M are as in grid.hpp, r is the direction, io the rounded origin.
//
// Non-zero components. Let scale = M min|r_i| and c_i = scale / r_i. Then floor_i <= c_i <= ceil_i and
// |c_i| <= M. Take a common point of ray and box at parameter t, and let T = t * scale * G >= 0. On every axis
// T = x c_i, where x = G t r_i lies between G (min - o) and G (max - o). As |io - G o| <= 1/2, the outward box has
//   d0 = floor(G min - 1/2) - io <= G (min - o)   and   d1 = ceil(G max + 1/2) - io >= G (max - o),
// so d0 <= x <= d1. The unit picks the near end by the sign of floor_i, which is the sign of r_i (the floor
// of a negative number is negative). It multiplies the near end by the bound of c_i that makes the product
// smaller, and the far end by the bound that makes it larger. So near_i <= T <= far_i. Hence max near <= min
// far and min far >= 0, and max near, an integer, is at most floor(length * scale * G). Cutting that number
// to 2^(2n-2) - 1 loses nothing, because near <= M^2 < 2^(2n-2) - 1. Trimming, x -> floor(x / 2^k), is
// monotone and keeps x >= 0.
//
// Zero components. The ray stays in the slab, so d0 <= 0 <= d1. Both bounds are +-M, so near_i <= 0 <= far_i.
// A non-zero axis has the bounds 0 and 1, or -1 and 0, so its near end is <= 0 and its far end >= 0 wherever
// the box lies. Then near <= 0 <= far and near <= 0 = length. There is no miss, but the non-zero axes decide
// nothing.

namespace {

constexpr std::string_view set_up_name = "IntSlabsRaySetup";

}  // namespace

IntSlabsRaySetup::IntSlabsRaySetup(const Ray& ray, hls::IntBits bits) : bits_(bits) {
  check_format(bits, set_up_name);
  check_ray(ray, set_up_name);
  for (int axis = 0; axis < 3; ++axis) {
    // To nearest, ties upwards. The error is at most exactly 1/2, which the half unit of the box covers.
    ray_.origin[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(fine_nearest(ray.origin[axis], bits.coord));
  }
  set_irdvcs(ray);
  ray_.infinite = ray.is_infinite();
  ray_.length = length(ray.length);
}

void IntSlabsRaySetup::set_irdvcs(const Ray& ray) {
  const std::int64_t limit = direction_limit(bits_.coord);
  const float smallest =
      std::min({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
  const bool infinitesimal_scale = smallest == 0.0F;
  const Binary32 least = infinitesimal_scale ? Binary32{} : decode(smallest);
  // |c_i| = M m_min / (m_i 2^k). k >= 0, and the numerator is below 2^55. From k = 32 on the component is
  // normal, m_i >= 2^23, and the quotient is 0. Neither the quotient nor its ceiling ever exceeds the integer
  // M.
  const std::uint64_t numerator = static_cast<std::uint64_t>(limit) * least.mantissa;
  for (int axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<std::size_t>(axis);
    const float component = ray.direction[axis];
    const bool negative = std::signbit(component);
    std::uint64_t below = 0;
    std::uint64_t above = 1;
    if (component == 0.0F) {
      below = above = static_cast<std::uint64_t>(limit);
    } else if (!infinitesimal_scale) {
      const Binary32 parts = decode(component);
      const int k = parts.exponent - least.exponent;
      if (k < 32) {
        const std::uint64_t denominator = static_cast<std::uint64_t>(parts.mantissa) << k;
        below = numerator / denominator;
        above = below + (numerator % denominator != 0 ? 1U : 0U);
      }
    }
    ray_.irdvc_floor[i] = negative ? -static_cast<std::int32_t>(above) : static_cast<std::int32_t>(below);
    ray_.irdvc_ceil[i] = negative ? -static_cast<std::int32_t>(below) : static_cast<std::int32_t>(above);
  }
  length_factor_ = static_cast<Uint128>(numerator) * static_cast<std::uint64_t>(grid_scale(bits_.coord));
  length_exponent_ = least.exponent;
}

std::int64_t IntSlabsRaySetup::length(float length) const {
  check_length(length, set_up_name);
  const Uint128 largest = (Uint128{1} << (2 * bits_.coord - 2)) - 1;
  Uint128 full = largest;
  if (!std::isinf(length)) {
    const Binary32 parts = decode(length);
    const Uint128 product = length_factor_ * parts.mantissa;  // < 2^109
    const int exponent = parts.exponent + length_exponent_;
    if (product == 0 || exponent <= -128) {
      full = 0;
    } else if (exponent < 0) {
      full = std::min(product >> -exponent, largest);
    }
    // Otherwise both exponents are >= -104, so both mantissas are normal. The product is then at least 2^46 M
    // G, which is more than the largest.
  }
  return static_cast<std::int64_t>(full >> bits_.trimmed());
}

}  // namespace hitpipe::ref
