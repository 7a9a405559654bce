// Binary floating point of any width, as a datapath sees it: a pattern of bits (IEEE 754: sign, E bits of
// biased exponent, M bits of fraction) and the operators that a pipeline calls. The operators' logic is
// bit-level code (fp_logic.hpp): rounding to nearest even, subnormals, infinities, NaN, signed zeros.
// Natively they run that logic; the trace domain has its own overloads, which record each as one component
// with that logic inside.
#pragma once

#include "hls/num/domain.hpp"
#include "hls/num/fp_logic.hpp"

namespace hitpipe::hls {

/// E 2..8 exponent bits, M 1..23 fraction bits; binary32 is E = 8, M = 23.
template <class D, int E, int M>
struct Fp {
  static_assert(E >= 2 && E <= 8 && M >= 1 && M <= 23, "a float has 2..8 exponent and 1..23 fraction bits");
  static constexpr int width = 1 + E + M;
  using Bits = typename D::template uint<width>;
  using Bit = typename D::bit;

  Bits bits;

  /// 1 for negative numbers, -0 included; NaN results have it 0.
  [[nodiscard]] constexpr Bit sign() const { return slice<width - 1, width - 1>(bits); }
};

/// What a magnitude comparator tells of two numbers; both bits 0: equal, or one of them is NaN.
template <class Bit>
struct Order {
  Bit less, greater;
};

/// a - b, rounded to nearest even; every NaN result is the positive quiet one with no other fraction bit.
template <class D, int E, int M>
constexpr Fp<D, E, M> fp_sub(const Fp<D, E, M>& a, const Fp<D, E, M>& b) {
  return {fp_logic::subtract<D, E, M>(a.bits, b.bits)};
}

/// a * b, rounded likewise.
template <class D, int E, int M>
constexpr Fp<D, E, M> fp_mul(const Fp<D, E, M>& a, const Fp<D, E, M>& b) {
  return {fp_logic::multiply<D, E, M>(a.bits, b.bits)};
}

/// Both orders from one comparator; -0 equals +0.
template <class D, int E, int M>
constexpr Order<typename D::bit> fp_compare(const Fp<D, E, M>& a, const Fp<D, E, M>& b) {
  using Bit = typename D::bit;
  const auto order = fp_logic::compare<D, E, M>(a.bits, b.bits);
  return {Bit(slice<0, 0>(order)), Bit(slice<1, 1>(order))};
}

/// a < b; false when either is NaN.
template <class D, int E, int M>
constexpr typename D::bit fp_less(const Fp<D, E, M>& a, const Fp<D, E, M>& b) {
  return fp_compare(a, b).less;
}

template <class Bit, class D, int E, int M>
constexpr Fp<D, E, M> select(const Bit& bit, const Fp<D, E, M>& a, const Fp<D, E, M>& b) {
  return {select(bit, a.bits, b.bits)};
}

/// Names a value in a traced graph; elsewhere x itself.
template <class D, int E, int M>
constexpr Fp<D, E, M> as(const char* /*name*/, const Fp<D, E, M>& x) {
  return x;
}
template <class D, int E, int M>
constexpr Fp<D, E, M> as(const char* /*name*/, char /*axis*/, const Fp<D, E, M>& x) {
  return x;
}

}  // namespace hitpipe::hls
