// The float multiplication before rounding. The product's leading zeros are those of its subnormal operand,
// so that they are counted while the multiplier works; one shifter then serves both directions.
#pragma once

#include "hls/num/fp_round.hpp"

namespace hitpipe::hls::fp_logic {

/// a * b by the two halves of b: bits of weight 2^1 down to 2^-2M.
template <class D, int M>
constexpr Word<D, 2 * M + 2> significand_product(const Word<D, M + 1>& a, const Word<D, M + 1>& b) {
  constexpr int half = (M + 1) / 2;
  const Word<D, M + 1 + half> low = as("product_low", Word<D, M + 1 + half>(a * slice<half - 1, 0>(b)));
  using High = Word<D, 2 * M + 2 - half>;
  const High high = as("product_high", High(a * slice<M, half>(b)));
  const High upper = as("product_upper", High(high + slice<M + half, half>(low)));
  return cat(upper, slice<half - 1, 0>(low));
}

/// How far to shift: left by 0 .. 2^S - 1, or, with `right`, that less 2^S.
template <class D, int S>
struct ProductShift {
  Word<D, S> amount;
  typename D::bit right;
};

/// product, shifted, in 2^S + M + 2 bits with the same top; its lowest M + 1 bits count as one of them once
/// it goes to the right.
template <class D, int M, int S>
constexpr Word<D, (1 << S) + M + 2> shift_product(const Word<D, 2 * M + 2>& product,
                                                  const ProductShift<D, S>& shift) {
  constexpr int span = 1 << S;
  constexpr int width = span + M + 2;
  const typename D::bit below = any<D, M + 1>(slice<M, 0>(product));
  const Word<D, M + 2> kept = cat(slice<2 * M + 1, M + 1>(product), below);
  const Word<D, width> from_right = cat(hls::lit<span, D>(0), kept);
  const Word<D, width> from_top = cat(product, hls::lit<width - (2 * M + 2), D>(0));
  const Word<D, width> start = select(shift.right, from_right, from_top);
  return as("shifted", shift_left<D, width, S>(start, shift.amount));
}

/// a * b of finite numbers other than zero.
template <class D, int E, int M>
constexpr Raw<D, E, M> raw_product(const Unpacked<D, E, M>& a, const Unpacked<D, E, M>& b) {
  using Bit = typename D::bit;
  constexpr int bias = (1 << (E - 1)) - 1;
  constexpr int shift_bits = count_bits(M + 2);
  constexpr int span = 1 << shift_bits;
  constexpr int width = span + M + 2;
  using Shift = Word<D, shift_bits>;
  // Biased, for a leading one of weight 1: bit 2M of the product.
  using Exponent = typename D::template sint<E + 2>;
  const Word<D, E + 1> biased_twice(a.exponent + b.exponent);
  const Exponent exponent = as("exponent", Exponent(biased_twice - hls::lit<E + 1, D>(bias)));

  // Two subnormal numbers' product reaches the subnormal exponent within one operand's zeros.
  const Word<D, M + 1> weaker = select(a.normal, b.significand, a.significand);
  const Shift zeros = as("leading_zeros", Shift(leading_zeros<D, M + 1>(weaker)));
  const Bit reaches(zeros < exponent);
  Shift limit(exponent);
  if constexpr (bias - 2 > span) {
    // All of the product lies below the guard bit after `span` places to the right.
    const Bit near(~Bit(exponent < Exponent(-span)));
    limit = Shift(limit & spread<D, shift_bits>(near));
  }
  ProductShift<D, shift_bits> shift;
  shift.amount = as("shift", select(reaches, zeros, limit));
  shift.right = slice<E + 1, E + 1>(exponent);
  const auto product = significand_product<D, M>(a.significand, b.significand);
  const Word<D, width> shifted = shift_product<D, M, shift_bits>(product, shift);

  // The leading one of two normal significands' product is in either of the top bits.
  const Bit top = slice<width - 1, width - 1>(shifted);
  const Bit lower(reaches & Bit(~top));
  const Word<D, M + 2> high_part = slice<width - 1, width - M - 2>(shifted);
  const Word<D, M + 2> next_part = slice<width - 2, width - M - 3>(shifted);
  const Word<D, M + 2> normalised = as("normalised", select(lower, next_part, high_part));
  const Bit passed(slice<width - M - 3, width - M - 3>(shifted) & Bit(~lower));
  const Word<D, E + 1> lowered(exponent - zeros);

  Raw<D, E, M> raw;
  raw.sign = Bit(a.sign ^ b.sign);
  raw.exponent = select(reaches, lowered, hls::lit<E + 1, D>(0));
  raw.carry = top;
  raw.fraction = slice<M, 1>(normalised);
  raw.guard = slice<0, 0>(normalised);
  raw.sticky = Bit(passed | any<D, width - M - 3>(slice<width - M - 4, 0>(shifted)));
  return raw;
}

}  // namespace hitpipe::hls::fp_logic
