// What std::ldexp, std::ilogb and std::lround do, without a call: a scene may place a million instances at a time.
#pragma once

#include <bit>
#include <cstdint>

namespace hitpipe::ref {

/// 2^e for e in -1022..1023.
[[nodiscard]] inline double power_of_two(int e) {
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + e) << 52U);
}

/// floor(log2 x) of a normal number.
[[nodiscard]] inline int exponent_of(double x) {
  return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52U & 0x7ffU) - 1023;
}

/// Of a number below 2^51 in size; ties go up.
[[nodiscard]] inline std::int64_t nearest(double x) {
  const double above = x + 0.5;
  const auto whole = static_cast<std::int64_t>(above);  // towards 0
  return static_cast<double>(whole) > above ? whole - 1 : whole;
}

}  // namespace hitpipe::ref
