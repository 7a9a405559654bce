// The float operators as bit-level logic: unpack, a raw operation, round and pack. IEEE 754 binary formats of
// E exponent and M fraction bits: round to nearest even, subnormals, infinities, NaN (canonical: positive,
// quiet, no payload), signed zeros; no flags, no other rounding. No value is wider than 64 bits.
#pragma once

#include "hls/num/fp_product.hpp"
#include "hls/num/fp_round.hpp"
#include "hls/num/fp_sum.hpp"

namespace hitpipe::hls::fp_logic {

/// a - b.
template <class D, int E, int M>
constexpr Word<D, 1 + E + M> subtract(const Word<D, 1 + E + M>& a, const Word<D, 1 + E + M>& b) {
  using Bit = typename D::bit;
  const Word<D, E + M> magnitude_a = slice<E + M - 1, 0>(a);
  const Word<D, E + M> magnitude_b = slice<E + M - 1, 0>(b);
  const Bit swap = as("swap", Bit(magnitude_a < magnitude_b));
  const Bit same = as("same", Bit(magnitude_a == magnitude_b));
  const Unpacked<D, E, M> ua = unpack<D, E, M>(a);
  const Unpacked<D, E, M> ub = unpack<D, E, M>(b);
  const Bit opposite = as("opposite", Bit(~Bit(ua.sign ^ ub.sign)));  // a and -b
  const Raw<D, E, M> raw = raw_difference<D, E, M>(ua, ub, swap, opposite);

  const Bit invalid(opposite & Bit(ua.infinite & ub.infinite));
  const Bit nan = as("nan", Bit(Bit(ua.nan | ub.nan) | invalid));
  const Bit infinite(ua.infinite | ub.infinite);
  const Bit cancels(opposite & same);  // to +0
  const Bit sign(raw.sign & Bit(~cancels));
  Special<D, E, M> special;
  special.any = as("special", Bit(cancels | Bit(nan | infinite)));
  special.bits = special_bits<D, E, M>(sign, nan, infinite);
  return round_and_pack<D, E, M>(raw, special);
}

/// a * b.
template <class D, int E, int M>
constexpr Word<D, 1 + E + M> multiply(const Word<D, 1 + E + M>& a, const Word<D, 1 + E + M>& b) {
  using Bit = typename D::bit;
  const Unpacked<D, E, M> ua = unpack<D, E, M>(a);
  const Unpacked<D, E, M> ub = unpack<D, E, M>(b);
  const Raw<D, E, M> raw = raw_product<D, E, M>(ua, ub);

  const Bit zero(ua.zero | ub.zero);
  const Bit infinite(ua.infinite | ub.infinite);
  const Bit nan = as("nan", Bit(Bit(ua.nan | ub.nan) | Bit(zero & infinite)));
  Special<D, E, M> special;
  special.any = as("special", Bit(zero | Bit(nan | infinite)));
  special.bits = special_bits<D, E, M>(raw.sign, nan, infinite);
  return round_and_pack<D, E, M>(raw, special);
}

/// Bit 0: a < b, bit 1: a > b; neither when they are equal, as -0 and +0 are, or one is NaN.
template <class D, int E, int M>
constexpr Word<D, 2> compare(const Word<D, 1 + E + M>& a, const Word<D, 1 + E + M>& b) {
  using Bit = typename D::bit;
  const Word<D, E + M> magnitude_a = slice<E + M - 1, 0>(a);
  const Word<D, E + M> magnitude_b = slice<E + M - 1, 0>(b);
  const Bit smaller = as("smaller", Bit(magnitude_a < magnitude_b));
  const Bit same = as("same", Bit(magnitude_a == magnitude_b));
  const Unpacked<D, E, M> ua = unpack<D, E, M>(a);
  const Unpacked<D, E, M> ub = unpack<D, E, M>(b);
  const Bit equal_or_nan(Bit(ua.nan | ub.nan) | Bit(ua.zero & ub.zero));
  const Bit opposite(ua.sign ^ ub.sign);
  const Bit apart = as("apart", Bit(Bit(~equal_or_nan) & Bit(opposite | Bit(~same))));
  // Of two negative numbers the smaller magnitude is the greater; of opposite signs the negative is the less.
  const Bit below = as("below", select(opposite, ua.sign, Bit(smaller ^ ua.sign)));
  const Bit less = as("less", Bit(apart & below));
  const Bit greater = as("greater", Bit(apart & Bit(~below)));
  return cat(greater, less);
}

}  // namespace hitpipe::hls::fp_logic
