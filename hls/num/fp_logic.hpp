// The float operators as bit-level logic: unpack, a raw operation, round and pack. IEEE 754 binary formats of
// E exponent and M fraction bits: round to nearest even, subnormals, infinities, NaN (canonical: positive,
// quiet, no payload), signed zeros; no flags, no other rounding. No value is wider than 64 bits.
#pragma once

#include "hls/num/fp_product.hpp"
#include "hls/num/fp_round.hpp"
#include "hls/num/fp_sum.hpp"

namespace hitpipe {
namespace hls {
namespace fp_logic {

/// a - b.
template <class D, class F, class X>
constexpr X subtract(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto below_sign = format.exponent + format.fraction - 1_w;
  const auto magnitude_a = slice(a, below_sign, 0_w);
  const auto magnitude_b = slice(b, below_sign, 0_w);
  const Bit swap = as("swap", Bit(magnitude_a < magnitude_b));
  const Bit same = as("same", Bit(magnitude_a == magnitude_b));
  const auto ua = unpack<D>(format, a);
  const auto ub = unpack<D>(format, b);
  const Bit opposite = as("opposite", ~(ua.sign ^ ub.sign));  // a and -b
  const auto raw = raw_difference(format, ua, ub, swap, opposite);

  const Bit invalid = opposite & (ua.infinite & ub.infinite);
  const Bit nan = as("nan", (ua.nan | ub.nan) | invalid);
  const Bit infinite = ua.infinite | ub.infinite;
  const Bit cancels = opposite & same;  // to +0
  const Bit negative = raw.sign & ~cancels;
  Special<D, F> special;
  special.any = as("special", cancels | (nan | infinite));
  special.bits = special_bits<D>(format, negative, nan, infinite);
  return round_and_pack(format, raw, special);
}

/// a * b.
template <class D, class F, class X>
constexpr X multiply(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto ua = unpack<D>(format, a);
  const auto ub = unpack<D>(format, b);
  const auto raw = raw_product(format, ua, ub);

  const Bit zero = ua.zero | ub.zero;
  const Bit infinite = ua.infinite | ub.infinite;
  const Bit nan = as("nan", (ua.nan | ub.nan) | (zero & infinite));
  Special<D, F> special;
  special.any = as("special", zero | (nan | infinite));
  special.bits = special_bits<D>(format, raw.sign, nan, infinite);
  return round_and_pack(format, raw, special);
}

/// Bit 0: a < b. Bit 1: a > b. Both are 0 when the numbers are equal, as -0 and +0 are, or one is NaN.
template <class D, class F, class X>
constexpr auto compare(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto below_sign = format.exponent + format.fraction - 1_w;
  const auto magnitude_a = slice(a, below_sign, 0_w);
  const auto magnitude_b = slice(b, below_sign, 0_w);
  const Bit smaller = as("smaller", Bit(magnitude_a < magnitude_b));
  const Bit same = as("same", Bit(magnitude_a == magnitude_b));
  const auto ua = unpack<D>(format, a);
  const auto ub = unpack<D>(format, b);
  const Bit equal_or_nan = (ua.nan | ub.nan) | (ua.zero & ub.zero);
  const Bit opposite = ua.sign ^ ub.sign;
  const Bit apart = as("apart", ~equal_or_nan & (opposite | ~same));
  // If both are negative, the smaller magnitude is greater. If signs differ, the negative number is less.
  const Bit below = as("below", select(opposite, ua.sign, smaller ^ ua.sign));
  const Bit less = as("less", apart & below);
  const Bit greater = as("greater", apart & ~below);
  return cat(greater, less);
}

}  // namespace fp_logic
}  // namespace hls
}  // namespace hitpipe
