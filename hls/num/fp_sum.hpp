// The float subtraction before rounding: the smaller magnitude aligned to the larger, one adder for sum and
// difference, and the leading one brought to the top. One path serves every distance of the exponents.
#pragma once

#include "hls/num/fp_round.hpp"

namespace hitpipe::hls::fp_logic {

/// A significand `distance` places to the right: two more bits, and a lowest one for all ones below them.
template <class D, int E, int M>
constexpr Word<D, M + 4> align(const Word<D, M + 1>& significand, const Word<D, E>& distance) {
  using Bit = typename D::bit;
  // Far enough to bring a whole significand below those two bits, unless no distance is that long.
  constexpr int enough = count_bits(M + 4);
  constexpr int amount_bits = enough < E ? enough : E;
  constexpr int width = M + (1 << amount_bits);
  constexpr int low = width - (M + 3);
  Word<D, amount_bits> amount = slice<amount_bits - 1, 0>(distance);
  if constexpr (amount_bits < E) {
    const Bit far = any<D, E - amount_bits>(slice<E - 1, amount_bits>(distance));
    amount = Word<D, amount_bits>(amount | spread<D, amount_bits>(far));
  }
  const Word<D, width> shifted = as("aligned", shift_right<D, M + 1, amount_bits>(significand, amount));
  return cat(slice<width - 1, low>(shifted), any<D, low>(slice<low - 1, 0>(shifted)));
}

/// sum, its top bit being one place above that of exponent's significands, as a raw result. The leading one
/// goes to the top bit, unless the exponent of subnormal numbers is reached before.
template <class D, int E, int M>
constexpr Raw<D, E, M> normalise(const typename D::bit& sign, const Word<D, E>& exponent,
                                 const Word<D, M + 5>& sum) {
  constexpr int width = M + 5;
  constexpr int shift_bits = count_bits(width);
  const Word<D, shift_bits> zeros = as("leading_zeros", leading_zeros<D, width>(sum));
  const typename D::bit reaches(zeros < exponent);
  const Word<D, shift_bits> shift = as("shift", select(reaches, zeros, resize<shift_bits>(exponent)));
  const Word<D, width> normalised = as("normalised", shift_left<D, width, shift_bits>(sum, shift));
  const Word<D, E> lowered(exponent - zeros);

  Raw<D, E, M> raw;
  raw.sign = sign;
  raw.exponent = Word<D, E + 1>(select(reaches, lowered, hls::lit<E, D>(0)));
  raw.carry = slice<width - 1, width - 1>(normalised);
  raw.fraction = slice<width - 2, 4>(normalised);
  raw.guard = slice<3, 3>(normalised);
  raw.sticky = any<D, 3>(slice<2, 0>(normalised));
  return raw;
}

/// a - b of finite numbers. swap: b has the larger magnitude; opposite: a and -b differ in sign.
template <class D, int E, int M>
constexpr Raw<D, E, M> raw_difference(const Unpacked<D, E, M>& a, const Unpacked<D, E, M>& b,
                                      const typename D::bit& swap, const typename D::bit& opposite) {
  using Bit = typename D::bit;
  using Exponent = Word<D, E>;
  const Exponent exponent = as("exponent", select(swap, b.exponent, a.exponent));
  const Exponent ahead(a.exponent - b.exponent);
  const Exponent behind(b.exponent - a.exponent);
  const Exponent distance = as("distance", select(swap, behind, ahead));
  const Word<D, M + 1> larger = as("larger", select(swap, b.significand, a.significand));
  const Word<D, M + 1> smaller = as("smaller", select(swap, a.significand, b.significand));
  const Word<D, M + 4> aligned = align<D, E, M>(smaller, distance);

  // A bit below both terms brings the one that completes the complement of the second.
  using Term = Word<D, M + 6>;
  const Word<D, M + 4> inverted(aligned ^ spread<D, M + 4>(opposite));
  const Term first = cat(Word<D, M + 2>(larger), cat(hls::lit<3, D>(0), opposite));
  const Term second = cat(opposite, cat(inverted, opposite));
  const Term total(first + second);
  const Word<D, M + 5> sum = as("raw_sum", slice<M + 5, 1>(total));
  return normalise<D, E, M>(select(swap, Bit(~b.sign), a.sign), exponent, sum);
}

}  // namespace hitpipe::hls::fp_logic
