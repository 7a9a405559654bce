// Both ends of every float operator: operands taken apart, and a raw result rounded to nearest even and
// packed (IEEE 754-2019, 4.3.1, 7.4, 7.5). A format has E exponent and M fraction bits, bias 2^(E-1) - 1; the
// exponent field 0 means the exponent of field 1 without the implicit one.
#pragma once

#include "hls/num/fp_parts.hpp"

namespace hitpipe::hls::fp_logic {

/// At most one of nan, infinite and zero is set.
template <class D, int E, int M>
struct Unpacked {
  typename D::bit sign;
  Word<D, E> exponent;         ///< biased, at least 1
  Word<D, M + 1> significand;  ///< with the implicit one
  typename D::bit nan, infinite, zero, normal;
};

template <class D, int E, int M>
constexpr Unpacked<D, E, M> unpack(const Word<D, 1 + E + M>& x) {
  using Bit = typename D::bit;
  const Word<D, E> field = slice<E + M - 1, M>(x);
  const Word<D, M> fraction = slice<M - 1, 0>(x);
  const Bit normal = any<D, E>(field);
  const Bit beyond(field == hls::lit<E, D>((1 << E) - 1));
  const Bit fractional = any<D, M>(fraction);

  Unpacked<D, E, M> u;
  u.sign = slice<E + M, E + M>(x);
  u.exponent = Word<D, E>(field | Word<D, E>(Bit(~normal)));
  u.significand = cat(normal, fraction);
  u.nan = Bit(beyond & fractional);
  u.infinite = Bit(beyond & Bit(~fractional));
  u.zero = Bit(Bit(~normal) & Bit(~fractional));
  u.normal = normal;
  return u;
}

/// A finite result before rounding: its exponent field is exponent + carry, its fraction is followed by a
/// guard bit, and sticky tells of any one below that.
template <class D, int E, int M>
struct Raw {
  typename D::bit sign;
  Word<D, E + 1> exponent;
  typename D::bit carry;
  Word<D, M> fraction;
  typename D::bit guard, sticky;
};

/// A result that the operands decide without arithmetic, or none (any = 0).
template <class D, int E, int M>
struct Special {
  typename D::bit any;
  Word<D, 1 + E + M> bits;
};

/// The canonical NaN, or with nan = 0 an infinity, or with both 0 a zero.
template <class D, int E, int M>
constexpr Word<D, 1 + E + M> special_bits(const typename D::bit& sign, const typename D::bit& nan,
                                          const typename D::bit& infinite) {
  using Bit = typename D::bit;
  const Word<D, M> quiet = select(nan, hls::lit<M, D>(1 << (M - 1)), hls::lit<M, D>(0));
  return cat(Bit(sign & Bit(~nan)), cat(spread<D, E>(Bit(nan | infinite)), quiet));
}

/// The nearest number, of two the even one; half an ulp beyond the largest, infinity. Or what is special.
template <class D, int E, int M>
constexpr Word<D, 1 + E + M> round_and_pack(const Raw<D, E, M>& raw, const Special<D, E, M>& special) {
  using Bit = typename D::bit;
  using Bits = Word<D, 1 + E + M>;
  using Magnitude = Word<D, E + M>;
  const Bit odd = slice<0, 0>(raw.fraction);
  const Bit up = as("round_up", Bit(raw.guard & Bit(raw.sticky | odd)));
  // One sum: the carry goes to the exponent, and so does that of a fraction rounded up from all ones, which
  // makes the smallest normal number of the largest subnormal one and infinity of the largest normal one.
  const Magnitude cut = cat(slice<E - 1, 0>(raw.exponent), raw.fraction);
  const Word<D, M + 1> increment = cat(raw.carry, Word<D, M>(up));
  const Magnitude rounded = as("rounded", Magnitude(cut + increment));

  const auto largest = hls::lit<E + 1, D>((1 << E) - 2);
  const Bit above(largest < raw.exponent);
  const Bit at(raw.exponent == largest);
  const Bit overflow = as("overflow", Bit(above | Bit(at & raw.carry)));
  const Bits infinity = cat(raw.sign, hls::lit<E + M, D>(((1 << E) - 1) << M));
  const Bits exceptional = as("exceptional", select(special.any, special.bits, infinity));
  return select(Bit(special.any | overflow), exceptional, Bits(cat(raw.sign, rounded)));
}

}  // namespace hitpipe::hls::fp_logic
