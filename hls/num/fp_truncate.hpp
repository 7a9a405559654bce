// Float operators that round toward zero, for finite numbers: what is below the last bit is left out. They
// are smaller than those to nearest (fp_logic.hpp): no result is incremented, and there are no NaN. What they
// do with other patterns is defined, but means nothing.
#pragma once

#include "hls/num/fp_product.hpp"
#include "hls/num/fp_sum.hpp"

namespace hitpipe {
namespace hls {
namespace fp_logic {

/// a - b for |a - b| below the largest number. Results below the smallest normal number are exact. A result
/// of zero is +0, unless a is -0 and b is +0.
template <class D, class F, class X>
constexpr X subtract_rz(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto magnitude_a = slice(a, e + m - 1_w, 0_w);
  const auto magnitude_b = slice(b, e + m - 1_w, 0_w);
  const auto ua = unpack<D>(format, a);
  const auto ub = unpack<D>(format, b);
  // Equal negative numbers are swapped, because the sign of a zero is then +.
  const Bit swap = as("swap", Bit(cat(magnitude_a, Bit(D::lit(0, 1_w))) < cat(magnitude_b, ub.sign)));
  const Bit opposite = as("opposite", ~(ua.sign ^ ub.sign));  // a and -b
  const auto terms = aligned_terms<D>(format, ua, ub, swap, 1_w);
  const auto sum = signed_sum<D>(format, terms, opposite, 1_w);

  const auto zeros = as("leading_zeros", leading_zeros<D>(sum));
  const Bit reaches(zeros < terms.exponent);
  const auto shift = as("shift", select(reaches, zeros, resize(terms.exponent, width_of(zeros))));
  const auto normalised = as("normalised", shift_left<D>(sum, shift));
  // The top bit of sum is one place above that of the significands. After the shift it is 0 in subnormal
  // numbers and in zero.
  const auto next = terms.exponent + D::lit(1, 1_w);
  const auto lowered = as_unsigned(resize(next - zeros, e));
  const auto field = select(reaches, lowered, D::lit(1, e)) & spread(sign(normalised), e);
  const Bit negative = select(swap, Bit(~ub.sign), ua.sign);
  return cat(negative, cat(field, slice(normalised, m + 2_w, 3_w)));
}

/// The product of two numbers without their signs. Both are read as normal numbers: a pattern with exponent
/// field 0 counts as (1 + fraction) 2^-bias, which is not less than the number that it stands for. b is at
/// least 1. If b is infinite or the product is 2^(bias+2) or more, all bits of the result are 1. The highest
/// exponent is that of finite numbers here, so patterns are in the order of the products.
template <class D, class F, class X>
constexpr X multiply_rz(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto field_a = slice(a, e + m - 1_w, m);
  const auto field_b = slice(b, e + m - 1_w, m);
  const Bit one(D::lit(1, 1_w));
  const auto product =
      significand_product(format, cat(one, slice(a, m - 1_w, 0_w)), cat(one, slice(b, m - 1_w, 0_w)));
  const Bit top = sign(product);
  const auto fraction = select(top, slice(product, m + m, m + 1_w), slice(product, m + m - 1_w, m));

  // Without a carry the field is field_a + field_b - bias = field_a + field_b + 1 - 2^(E-1). As field_b is at
  // least the bias, the last term only changes the two top bits of the sum: 01, 10, 11 become 00, 01, 10.
  const auto by_one = slice(cat(field_a, one) + cat(field_b, one), e + 1_w, 1_w);
  const auto by_two = slice(by_one + one, e, 0_w);
  const auto sum = as("exponent", select(top, by_two, by_one));
  const Bit highest = sign(sum);
  const Bit infinite(field_b == D::lit((1 << e) - 1, e));
  const Bit most = as("overflow", Bit((highest & bit_at(sum, e - 1_w)) | infinite));
  return cat(highest, cat(slice(sum, e - 2_w, 0_w), fraction)) | spread(most, e + m);
}

}  // namespace fp_logic
}  // namespace hls
}  // namespace hitpipe
