// The float subtraction before rounding. The smaller magnitude is aligned to the larger, one adder serves sum
// and difference, and the leading one is moved to the top. One path serves every distance of the exponents.
#pragma once

#include "hls/num/fp_round.hpp"

namespace hitpipe {
namespace hls {
namespace fp_logic {

/// A significand shifted right by `distance`, with `guards` more bits and a last bit, which is the OR of all
/// bits below them.
template <class D, class F, class Significand, class Distance, class Guards>
constexpr auto align(const F& format, const Significand& significand, const Distance& distance,
                     const Guards& guards) {
  const auto e = format.exponent;
  const auto m = format.fraction;
  // Far enough to move a whole significand below those bits, unless distances are never that long.
  const auto amount_bits = min(count_bits(m + 2_w + guards), e);
  const auto amount = change_if(amount_bits < e, distance, [&](const auto& any_distance) {
    const auto far = any<D>(slice(any_distance, e - 1_w, amount_bits));
    return slice(any_distance, amount_bits - 1_w, 0_w) | spread(far, amount_bits);
  });
  const auto shifted = as("aligned", shift_right<D>(significand, amount));
  const auto low = width_of(shifted) - (m + 1_w + guards);
  return cat(slice(shifted, width_of(shifted) - 1_w, low), any<D>(slice(shifted, low - 1_w, 0_w)));
}

/// `sum` as a raw result. The top bit of sum is one place above the top bit of a significand of `exponent`.
/// The leading one moves to the top bit, unless it reaches the exponent of subnormal numbers before.
template <class D, class F, class Exponent, class Sum>
constexpr Raw<D, F> normalise(const F& format, const typename D::bit& negative, const Exponent& exponent,
                              const Sum& sum) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto zeros = as("leading_zeros", leading_zeros<D>(sum));
  const Bit reaches(zeros < exponent);
  const auto shift = as("shift", select(reaches, zeros, resize(exponent, width_of(zeros))));
  const auto normalised = as("normalised", shift_left<D>(sum, shift));
  const auto lowered = as_unsigned(resize(exponent - zeros, e));

  Raw<D, F> raw;
  raw.sign = negative;
  raw.exponent = resize(select(reaches, lowered, D::lit(0, e)), e + 1_w);
  raw.carry = sign(normalised);
  raw.fraction = slice(normalised, m + 3_w, 4_w);
  raw.guard = bit_at(normalised, 3_w);
  raw.sticky = any<D>(slice(normalised, 2_w, 0_w));
  return raw;
}

/// The terms of a sum: the larger significand, its exponent, and the smaller one aligned to it.
template <class Exponent, class Larger, class Aligned>
struct SumTerms {
  Exponent exponent;
  Larger larger;
  Aligned aligned;
};
template <class Exponent, class Larger, class Aligned>
constexpr SumTerms<Exponent, Larger, Aligned> sum_terms(const Exponent& exponent, const Larger& larger,
                                                        const Aligned& aligned) {
  return {exponent, larger, aligned};
}

/// swap: b has the larger magnitude.
template <class D, class F, class Guards>
constexpr auto aligned_terms(const F& format, const Unpacked<D, F>& a, const Unpacked<D, F>& b,
                             const typename D::bit& swap, const Guards& guards) {
  const auto e = format.exponent;
  const auto exponent = as("exponent", select(swap, b.exponent, a.exponent));
  const auto ahead = as_unsigned(resize(a.exponent - b.exponent, e));
  const auto behind = as_unsigned(resize(b.exponent - a.exponent, e));
  const auto distance = as("distance", select(swap, behind, ahead));
  const auto larger = as("larger", select(swap, b.significand, a.significand));
  const auto smaller = as("smaller", select(swap, a.significand, b.significand));
  return sum_terms(exponent, larger, align<D>(format, smaller, distance, guards));
}

/// The sum of the terms, or with `opposite` their difference. Its top bit is one place above theirs.
template <class D, class F, class Terms, class Guards>
constexpr auto signed_sum(const F& format, const Terms& terms, const typename D::bit& opposite,
                          const Guards& guards) {
  const auto m = format.fraction;
  // A bit below both terms adds the one that completes the complement of the second term.
  const auto inverted = terms.aligned ^ spread(opposite, m + 2_w + guards);
  const auto first = cat(resize(terms.larger, m + 2_w), cat(D::lit(0, guards + 1_w), opposite));
  const auto second = cat(opposite, cat(inverted, opposite));
  return as("raw_sum", slice(first + second, m + 3_w + guards, 1_w));
}

/// a - b of finite numbers. swap: b has the larger magnitude; opposite: a and -b differ in sign.
template <class D, class F>
constexpr Raw<D, F> raw_difference(const F& format, const Unpacked<D, F>& a, const Unpacked<D, F>& b,
                                   const typename D::bit& swap, const typename D::bit& opposite) {
  const auto terms = aligned_terms<D>(format, a, b, swap, 2_w);
  const auto sum = signed_sum<D>(format, terms, opposite, 2_w);
  return normalise<D>(format, select(swap, typename D::bit(~b.sign), a.sign), terms.exponent, sum);
}

}  // namespace fp_logic
}  // namespace hls
}  // namespace hitpipe
