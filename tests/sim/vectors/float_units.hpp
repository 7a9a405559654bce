// The float components of a graph on the host, with rounding to nearest in binary32 only, and what their
// faults are made of. Numbers are
// patterns.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

#include "hls/box/fp_format.hpp"
#include "hls/num/domain.hpp"
#include "hls/num/fp.hpp"
#include "hls/num/sized.hpp"
#include "rtl_gen/graph/graph.hpp"

namespace hitpipe::sim::fp {

inline constexpr rtl::Word sign_bit = 0x80000000U;
inline constexpr rtl::Word infinity = 0x7F800000U;

enum class Operator { subtract, multiply, compare, subtract_rz, multiply_rz };

inline Operator operator_of(const rtl::Submodule& unit) {
  if (unit.component == "fp_subtract_rz") return Operator::subtract_rz;
  if (unit.component == "fp_multiply_rz") return Operator::multiply_rz;
  if (unit.bits != 32) throw std::logic_error("a float that is no binary32");
  if (unit.component == "fp_subtract") return Operator::subtract;
  if (unit.component == "fp_multiply") return Operator::multiply;
  if (unit.component == "fp_compare") return Operator::compare;
  throw std::logic_error("an unknown float component: " + unit.component);
}

using Pattern = hls::ap_uint<32>;

inline Pattern pattern(rtl::Word bits) {
  return static_cast<std::int64_t>(bits);
}
inline rtl::Word subtract(rtl::Word a, rtl::Word b) {
  return hls::fp_logic::subtract<hls::Native>(hls::Fp32(), pattern(a), pattern(b)).word();
}
inline rtl::Word multiply(rtl::Word a, rtl::Word b) {
  return hls::fp_logic::multiply<hls::Native>(hls::Fp32(), pattern(a), pattern(b)).word();
}
/// Bit 0: less. Bit 1: greater.
inline rtl::Word compare(rtl::Word a, rtl::Word b) {
  return hls::fp_logic::compare<hls::Native>(hls::Fp32(), pattern(a), pattern(b)).word();
}

/// The unit's name ends with the format: fp_subtract_rz_8_15.
inline hls::FpBits format_of(const rtl::Submodule& unit) {
  const std::string& name = unit.body.name();
  const std::size_t last = name.rfind('_');
  return {std::stoi(name.substr(name.rfind('_', last - 1) + 1)), std::stoi(name.substr(last + 1))};
}
inline rtl::Word subtract_rz(const hls::FpBits& format, rtl::Word a, rtl::Word b) {
  const int width = format.width();
  return hls::fp_logic::subtract_rz<hls::Sized>(format,
                                                hls::Sized::uint(static_cast<std::uint64_t>(a), width),
                                                hls::Sized::uint(static_cast<std::uint64_t>(b), width))
      .word();
}
inline rtl::Word multiply_rz(const hls::FpBits& format, rtl::Word a, rtl::Word b) {
  const int width = format.width() - 1;
  return hls::fp_logic::multiply_rz<hls::Sized>(format,
                                                hls::Sized::uint(static_cast<std::uint64_t>(a), width),
                                                hls::Sized::uint(static_cast<std::uint64_t>(b), width))
      .word();
}

inline rtl::Word negated(rtl::Word x) {
  return x ^ sign_bit;
}
inline rtl::Word magnitude(rtl::Word x) {
  return x & ~sign_bit;
}
inline bool is_nan(rtl::Word x) {
  return magnitude(x) > infinity;
}
inline bool unordered(rtl::Word a, rtl::Word b) {
  return is_nan(a) || is_nan(b);
}
inline bool are_equal(rtl::Word a, rtl::Word b) {
  return !unordered(a, b) && compare(a, b) == 0;
}
/// Less for greater.
inline rtl::Word swapped(rtl::Word order) {
  return order >> 1 | (order & 1U) << 1;
}
inline rtl::Word farther_from_0(rtl::Word x) {
  return magnitude(x) < infinity ? x + 1 : x;
}
inline rtl::Word nearer_to_0(rtl::Word x) {
  return magnitude(x) != 0 && !is_nan(x) ? x - 1 : x;
}

}  // namespace hitpipe::sim::fp
