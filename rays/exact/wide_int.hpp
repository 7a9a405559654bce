// Integers for the slow exact path: binary32 values in units of 2^-149. Only .cpp files of rays/exact
// include this. Width: a coordinate difference is below 2^278 units and a direction component below 2^277, so
// a triple product is below 6 * 2^834 < 2^837 and the product of two of them below 2^1674.
#pragma once

#include <array>

#include <boost/multiprecision/cpp_int.hpp>
#include <glm/vec3.hpp>

#include "rays/exact/binary32.hpp"

namespace hitpipe::ref {

/// log2 of the number of units in 1.
inline constexpr unsigned unit_bits = 149;

using WideInt = boost::multiprecision::number<
    boost::multiprecision::cpp_int_backend<2048, 2048, boost::multiprecision::signed_magnitude,
                                           boost::multiprecision::unchecked, void>,
    boost::multiprecision::et_off>;
using WideVec = std::array<WideInt, 3>;

/// x * 2^149 for a finite x: exact.
[[nodiscard]] inline WideInt in_units(float x) {
  const Binary32 parts = decode(x);
  WideInt units = parts.mantissa;
  units <<= static_cast<unsigned>(parts.exponent + static_cast<int>(unit_bits));
  return parts.negative ? WideInt(-units) : units;
}

[[nodiscard]] inline WideVec in_units(const glm::vec3& v) {
  return {in_units(v.x), in_units(v.y), in_units(v.z)};
}

[[nodiscard]] inline WideVec difference(const WideVec& p, const WideVec& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

[[nodiscard]] inline WideVec cross(const WideVec& p, const WideVec& q) {
  return {p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]};
}

[[nodiscard]] inline WideInt dot(const WideVec& p, const WideVec& q) {
  return p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
}

}  // namespace hitpipe::ref
