// Binary floating point of any width, as a datapath sees it: a pattern of bits (IEEE 754: sign, E bits of
// biased exponent, M bits of fraction) and the operators that a pipeline calls. Their logic is bit-level code
// (fp_logic.hpp) with rounding to nearest even, subnormals, infinities, NaN and signed zeros. Those that end
// in _rz round toward zero instead and are for finite numbers (fp_truncate.hpp). The host runs that logic.
// The trace domain has its own overloads, which record each operator as one component with that logic inside.
#pragma once

#include "hls/num/bits.hpp"
#include "hls/num/fp_logic.hpp"
#include "hls/num/fp_truncate.hpp"

namespace hitpipe {
namespace hls {

/// A number of domain D in format F: its widths are F's `exponent` (E) and `fraction` (M), Width<N> or int.
template <class D, class F>
struct Fp {
  using Bit = typename D::bit;

  typename F::template Pattern<D> bits;
  F format{};
};

/// The pattern of a number that is not negative, without its sign.
template <class D, class F>
struct FpMagnitude {
  using Bit = typename D::bit;

  typename F::template Magnitude<D> bits;
  F format{};
};

/// 1 for negative numbers, also for -0. It is 0 in NaN results.
template <class D, class F>
constexpr typename D::bit sign(const Fp<D, F>& x) {
  return sign(x.bits);
}

/// What a magnitude comparator tells about two numbers. Both bits are 0 if they are equal or one is NaN.
template <class Bit>
struct Order {
  Bit less, greater;
};

/// a - b, rounded to nearest even. Every NaN result is the positive quiet NaN without payload.
template <class D, class F>
constexpr Fp<D, F> fp_sub(const Fp<D, F>& a, const Fp<D, F>& b) {
  return {fp_logic::subtract<D>(a.format, a.bits, b.bits), a.format};
}

/// a * b, rounded in the same way.
template <class D, class F>
constexpr Fp<D, F> fp_mul(const Fp<D, F>& a, const Fp<D, F>& b) {
  return {fp_logic::multiply<D>(a.format, a.bits, b.bits), a.format};
}

/// a - b of finite numbers, rounded toward zero; the error is at most one unit of the last place. If a < b,
/// only the sign bit has a meaning. Zeros and small numbers: see fp_truncate.hpp.
template <class D, class F>
constexpr Fp<D, F> fp_sub_rz(const Fp<D, F>& a, const Fp<D, F>& b) {
  return {fp_logic::subtract_rz<D>(a.format, a.bits, b.bits), a.format};
}

/// a * b for finite a and b >= 1, rounded toward zero. Subnormal a and large products: see fp_truncate.hpp.
template <class D, class F>
constexpr FpMagnitude<D, F> fp_mul_rz(const FpMagnitude<D, F>& a, const FpMagnitude<D, F>& b) {
  return {fp_logic::multiply_rz<D>(a.format, a.bits, b.bits), a.format};
}

/// Both orders from one comparator; -0 equals +0.
template <class D, class F>
constexpr Order<typename D::bit> fp_compare(const Fp<D, F>& a, const Fp<D, F>& b) {
  const auto order = fp_logic::compare<D>(a.format, a.bits, b.bits);
  return {bit_at(order, 0_w), bit_at(order, 1_w)};
}

/// a < b; false when either is NaN.
template <class D, class F>
constexpr typename D::bit fp_less(const Fp<D, F>& a, const Fp<D, F>& b) {
  return fp_compare(a, b).less;
}

/// -x.
template <class D, class F>
constexpr Fp<D, F> negated(const Fp<D, F>& x) {
  const auto below_sign = x.format.exponent + x.format.fraction - 1_w;
  return {cat(typename D::bit(~sign(x.bits)), slice(x.bits, below_sign, 0_w)), x.format};
}

/// |x|.
template <class D, class F>
constexpr FpMagnitude<D, F> magnitude(const Fp<D, F>& x) {
  const auto below_sign = x.format.exponent + x.format.fraction - 1_w;
  return {slice(x.bits, below_sign, 0_w), x.format};
}

/// +0 in the format of x.
template <class D, class F>
constexpr Fp<D, F> fp_zero(const Fp<D, F>& x) {
  return {D::lit(0, width_of(x.bits)), x.format};
}

template <class Bit, class D, class F>
constexpr Fp<D, F> select(const Bit& bit, const Fp<D, F>& a, const Fp<D, F>& b) {
  return {select(bit, a.bits, b.bits), a.format};
}

template <class D, class F>
constexpr Fp<D, F> as(const char* /*name*/, const Fp<D, F>& x) {
  return x;
}
template <class D, class F>
constexpr Fp<D, F> as(const char* /*name*/, char /*axis*/, const Fp<D, F>& x) {
  return x;
}
template <class D, class F>
constexpr FpMagnitude<D, F> as(const char* /*name*/, char /*axis*/, const FpMagnitude<D, F>& x) {
  return x;
}

}  // namespace hls
}  // namespace hitpipe
