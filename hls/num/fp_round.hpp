// Both ends of every float operator: taking operands apart, and rounding and packing a raw result to nearest
// even (IEEE 754-2019, 4.3.1, 7.4, 7.5). A format has E exponent and M fraction bits and bias 2^(E-1) - 1.
// The exponent field 0 means the exponent of field 1 without the implicit one.
#pragma once

#include "hls/num/fp_parts.hpp"

namespace hitpipe {
namespace hls {
namespace fp_logic {

/// At most one of nan, infinite and zero is set.
template <class D, class F>
struct Unpacked {
  typename D::bit sign;
  Word<D, decltype(F::exponent)> exponent;           ///< biased, at least 1
  Word<D, decltype(F::fraction + 1_w)> significand;  ///< with the implicit one
  typename D::bit nan, infinite, zero, normal;
};

template <class D, class F, class X>
constexpr Unpacked<D, F> unpack(const F& format, const X& x) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto field = slice(x, e + m - 1_w, m);
  const auto fraction = slice(x, m - 1_w, 0_w);
  const Bit normal = any<D>(field);
  const Bit beyond(field == D::lit((1 << e) - 1, e));
  const Bit fractional = any<D>(fraction);

  Unpacked<D, F> u;
  u.sign = sign(x);
  u.exponent = field | resize(Bit(~normal), e);
  u.significand = cat(normal, fraction);
  u.nan = beyond & fractional;
  u.infinite = beyond & ~fractional;
  u.zero = ~normal & ~fractional;
  u.normal = normal;
  return u;
}

/// A finite result before rounding. Its exponent field is exponent + carry. A guard bit follows its fraction.
/// sticky is 1 if any bit below that is.
template <class D, class F>
struct Raw {
  typename D::bit sign;
  Word<D, decltype(F::exponent + 1_w)> exponent;
  typename D::bit carry;
  Word<D, decltype(F::fraction)> fraction;
  typename D::bit guard, sticky;
};

/// A result that follows from the operands without arithmetic. any = 0: there is none.
template <class D, class F>
struct Special {
  typename D::bit any;
  typename F::template Pattern<D> bits;
};

/// The canonical NaN; with nan = 0 an infinity; with both 0 a zero.
template <class D, class F, class Bit>
constexpr auto special_bits(const F& format, const Bit& negative, const Bit& nan, const Bit& infinite) {
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto quiet = select(nan, D::lit(1 << (m - 1), m), D::lit(0, m));
  return cat(Bit(negative & ~nan), cat(spread(nan | infinite, e), quiet));
}

/// The nearest number, and the even one of two. Half an ulp beyond the largest it is infinity. Special
/// results pass.
template <class D, class F>
constexpr auto round_and_pack(const F& format, const Raw<D, F>& raw, const Special<D, F>& special) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const Bit odd = bit_at(raw.fraction, 0_w);
  const Bit up = as("round_up", raw.guard & (raw.sticky | odd));
  // One sum does both. A carry goes to the exponent. So does a fraction rounded up from all ones: the largest
  // subnormal number becomes the smallest normal one, and the largest normal one becomes infinity.
  const auto cut = cat(slice(raw.exponent, e - 1_w, 0_w), raw.fraction);
  const auto increment = cat(raw.carry, resize(up, m));
  const auto rounded = as("rounded", resize(cut + increment, e + m));

  const int all_ones = (1 << e) - 1;
  const auto largest = D::lit(all_ones - 1, e + 1_w);
  const Bit above(largest < raw.exponent);
  const Bit at(raw.exponent == largest);
  const Bit overflow = as("overflow", above | (at & raw.carry));
  const auto infinity = cat(raw.sign, D::lit(all_ones << m, e + m));
  const auto exceptional = as("exceptional", select(special.any, special.bits, infinity));
  return select(special.any | overflow, exceptional, cat(raw.sign, rounded));
}

}  // namespace fp_logic
}  // namespace hls
}  // namespace hitpipe
