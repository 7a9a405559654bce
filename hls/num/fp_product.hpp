// The float multiplication before rounding. The product has as many leading zeros as its subnormal
// operand. So they are counted while the multiplier works, and one shifter serves both directions.
#pragma once

#include "hls/num/fp_round.hpp"

namespace hitpipe {
namespace hls {
namespace fp_logic {

/// a * b by the two halves of b: bits of weight 2^1 down to 2^-2M.
template <class F, class Significand>
constexpr auto significand_product(const F& format, const Significand& a, const Significand& b) {
  const auto m = format.fraction;
  const auto half = (m + 1_w) / 2_w;
  const auto low = as("product_low", a * slice(b, half - 1_w, 0_w));
  const auto high = as("product_high", a * slice(b, m, half));
  const auto upper =
      as("product_upper", resize(high + slice(low, m + half, half), m + 1_w + (m + 1_w - half)));
  return cat(upper, slice(low, half - 1_w, 0_w));
}

/// The shift: left by `amount`, or, with `right`, by amount - 2^s, where s is the width of amount.
template <class Amount, class Bit>
struct ProductShift {
  Amount amount;
  Bit right;
};
template <class Amount, class Bit>
constexpr ProductShift<Amount, Bit> product_shift(const Amount& amount, const Bit& right) {
  return {amount, right};
}

/// The shifted product in 2^s + M + 2 bits, with the same top. After a right shift its lowest M + 1 bits
/// count as one bit.
template <class D, class F, class Product, class Amount, class Bit>
constexpr auto shift_product(const F& format, const Product& product,
                             const ProductShift<Amount, Bit>& shift) {
  const auto m = format.fraction;
  const auto span = power_of_two(width_of(shift.amount));
  const auto width = span + m + 2_w;
  const Bit below = any<D>(slice(product, m, 0_w));
  const auto kept = cat(slice(product, m + m + 1_w, m + 1_w), below);
  const auto from_right = cat(D::lit(0, span), kept);
  const auto from_top = cat(product, D::lit(0, width - (m + m + 2_w)));
  const auto start = select(shift.right, from_right, from_top);
  return as("shifted", shift_left<D>(start, shift.amount));
}

/// a * b of finite numbers other than zero.
template <class D, class F>
constexpr Raw<D, F> raw_product(const F& format, const Unpacked<D, F>& a, const Unpacked<D, F>& b) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto bias = power_of_two(e - 1_w) - 1_w;
  const auto shift_bits = count_bits(m + 2_w);
  const auto span = power_of_two(shift_bits);
  // Biased, for a leading one of weight 1: bit 2M of the product.
  const auto exponent = as("exponent", (a.exponent + b.exponent) - D::lit(bias, e + 1_w));

  // The product of two subnormal numbers reaches the subnormal exponent within the zeros of one operand.
  const auto weaker = select(a.normal, b.significand, a.significand);
  const auto zeros = as("leading_zeros", resize(leading_zeros<D>(weaker), shift_bits));
  const Bit reaches(zeros < exponent);
  const auto low_exponent = as_unsigned(resize(exponent, shift_bits));
  const auto limit = change_if(span < bias - 2_w, low_exponent, [&](const auto& limited) {
    // After `span` places to the right, the whole product lies below the guard bit.
    const Bit far(exponent < as_signed(D::lit(-span, e + 2_w)));
    return limited & spread(Bit(~far), shift_bits);
  });
  const auto shift = product_shift(as("shift", select(reaches, zeros, limit)), sign(exponent));
  const auto product = significand_product(format, a.significand, b.significand);
  const auto shifted = shift_product<D>(format, product, shift);

  // The product of two normal significands has its leading one in one of the two top bits.
  const auto highest = width_of(shifted) - 1_w;
  const Bit top = bit_at(shifted, highest);
  const Bit lower = reaches & ~top;
  const auto high_part = slice(shifted, highest, highest - m - 1_w);
  const auto next_part = slice(shifted, highest - 1_w, highest - m - 2_w);
  const auto normalised = as("normalised", select(lower, next_part, high_part));
  const Bit passed = bit_at(shifted, highest - m - 2_w) & ~lower;
  const auto lowered = as_unsigned(resize(exponent - zeros, e + 1_w));

  Raw<D, F> raw;
  raw.sign = a.sign ^ b.sign;
  raw.exponent = select(reaches, lowered, D::lit(0, e + 1_w));
  raw.carry = top;
  raw.fraction = slice(normalised, m, 1_w);
  raw.guard = bit_at(normalised, 0_w);
  raw.sticky = passed | any<D>(slice(shifted, highest - m - 3_w, 0_w));
  return raw;
}

}  // namespace fp_logic
}  // namespace hls
}  // namespace hitpipe
