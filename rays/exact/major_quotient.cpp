#include "rays/exact/major_quotient.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "rays/exact/binary32.hpp"
#include "rays/exact/grid.hpp"

namespace hitpipe::ref {

namespace {

__extension__ typedef unsigned __int128 Uint128;

}  // namespace

MajorQuotient largest_quotient(const hls::MajorBits& bits) {
  const auto largest = static_cast<std::uint32_t>(bits.largest_mantissa());
  return {largest, largest, bits.largest_exponent()};
}

/// The smallest exponent for which the upper mantissa fits p bits.
MajorQuotient quotient_bounds(std::uint64_t above, std::uint64_t below, int exponent,
                              const hls::MajorBits& bits) {
  const auto largest = static_cast<std::uint32_t>(bits.largest_mantissa());
  // The quotient is q 2^exponent with q in [1, 2).
  const int halved = above < below ? 1 : 0;
  exponent -= halved;
  if (exponent > bits.largest_exponent()) return largest_quotient(bits);
  const Uint128 numerator = static_cast<Uint128>(above) << (bits.mantissa - 1 + halved);
  const auto low = static_cast<std::uint32_t>(numerator / below);
  const bool exact = numerator % below == 0;
  if (exact) return {low, low, exponent};
  if (low < largest) return {low, low + 1, exponent};
  // The upper bound would be 2: half of it, with the next exponent.
  if (exponent == bits.largest_exponent()) return largest_quotient(bits);
  return {largest >> 1, (largest >> 1) + 1, exponent + 1};
}

MajorQuotient quotient_of(std::uint64_t above, std::uint64_t below, const hls::MajorBits& bits) {
  if (below == 0) {
    const std::uint32_t one = 1U << static_cast<unsigned>(bits.mantissa - 1);
    return {one, one, bits.largest_exponent()};
  }
  const int shift = std::countl_zero(below) - std::countl_zero(above);
  return quotient_bounds(above, below << shift, shift, bits);
}

int major_axis(const glm::vec3& direction) {
  int major = 0;
  for (int axis = 1; axis < 3; ++axis)
    if (std::abs(direction[axis]) > std::abs(direction[major])) major = axis;
  return major;
}

std::int64_t length_along_major(float length, float major, int coord, int fraction, std::int64_t largest) {
  if (std::isinf(length)) return largest;
  const Binary32 distance = decode(length);
  const Binary32 component = decode(major);
  const Uint128 product = static_cast<Uint128>(static_cast<std::uint64_t>(grid_scale(coord))) *
                          distance.mantissa * component.mantissa;  // < 2^78
  const int exponent = distance.exponent + component.exponent + fraction;
  if (product == 0 || exponent <= -128) return 0;
  // From 2^40 on anything is larger than the largest length.
  if (exponent >= 40) return largest;
  const Uint128 full = exponent < 0 ? product >> -exponent : product << exponent;
  return static_cast<std::int64_t>(std::min(full, static_cast<Uint128>(static_cast<std::uint64_t>(largest))));
}

}  // namespace hitpipe::ref
