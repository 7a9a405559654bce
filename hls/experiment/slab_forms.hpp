// Other ways to the distance of a plane, (plane - origin) * inverse, than that of fp_slabs_safe, which rounds
// the difference and then the product. They were measured, and no unit has them (docs/safe_floats.md,
// "Fusion"). Formats, patterns and the cut toward zero are those of fp_truncate.hpp. Each distance is a sign
// above a pattern without sign. If the sign is 1, the pattern means nothing.
#pragma once

#include "hls/num/fp_truncate.hpp"

namespace hitpipe {
namespace hls {
namespace slab_forms {

/// x shifted right in its own width. The lowest bit is the OR of itself and of all bits that are lost.
template <class D, class X, class Amount>
constexpr X shift_right_sticky(const X& x, const Amount& amount) {
  const auto w = width_of(x);
  return for_each_level(width_of(amount), x, [&](const auto& so_far, const auto& level) {
    const auto by = power_of_two(level);
    const typename D::bit lost = any<D>(slice(so_far, by - 1_w, 0_w));
    const auto moved = cat(D::lit(0, by), slice(so_far, w - 1_w, by)) | resize(lost, w);
    return select(bit_at(amount, level), moved, so_far);
  });
}

/// Far enough to shift all of x out, unless distances are never that long.
template <class D, class X, class Distance>
constexpr X align(const X& x, const Distance& distance) {
  const auto bits = min(count_bits(width_of(x)), width_of(distance));
  const auto amount = change_if(bits < width_of(distance), distance, [&](const auto& any_distance) {
    const auto far = any<D>(slice(any_distance, width_of(distance) - 1_w, bits));
    return slice(any_distance, bits - 1_w, 0_w) | spread(far, bits);
  });
  return as("aligned", shift_right_sticky<D>(x, amount));
}

/// a - b with a sticky bit, as subtract_rz but cut exactly toward zero: nothing is borrowed. Results below
/// the smallest normal number are exact subnormal numbers.
template <class D, class F, class X>
constexpr X subtract_exact(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto ua = fp_logic::unpack<D>(format, a);
  const auto ub = fp_logic::unpack<D>(format, b);
  const Bit opposite = as("opposite", ~(ua.sign ^ ub.sign));  // a and -b
  const auto ahead = ua.exponent - ub.exponent;
  const auto behind = ub.exponent - ua.exponent;
  const Bit swap = as("swap", select(opposite, ua.sign, Bit(sign(ahead))));
  const auto gap = as("gap", select(swap, behind, ahead));
  const auto exponent = as("exponent", select(swap, ub.exponent, ua.exponent));
  const auto larger = as("larger", select(swap, ub.significand, ua.significand));
  const auto smaller = as("smaller", select(swap, ua.significand, ub.significand));
  const auto aligned = align<D>(cat(smaller, D::lit(0, 2_w)), as_unsigned(resize(gap, e)));
  const auto sum =
      fp_logic::signed_sum<D>(format, fp_logic::sum_terms(exponent, larger, aligned), opposite, 1_w);
  const Bit negative = as("negative", select(opposite, Bit(sign(gap) | sign(sum)), ua.sign));
  const auto zeros = as("leading_zeros", fp_logic::leading_zeros<D>(sum));
  const Bit reaches(zeros < exponent);
  const auto shift = as("shift", select(reaches, zeros, resize(exponent, width_of(zeros))));
  const auto normalised = as("normalised", fp_logic::shift_left<D>(sum, shift));
  const auto next = exponent + D::lit(1, 1_w);
  const auto lowered = as_unsigned(resize(next - zeros, e));
  const auto field = select(reaches, lowered, D::lit(1, e)) & spread(sign(normalised), e);
  return cat(negative, cat(field, slice(normalised, m + 2_w, 3_w)));
}

/// multiply_rz without the partial products of a's `cut` lowest bits and b's lower half. The result is less
/// than 2^(cut + half - 2M) of the product too small before it is cut, and never too large.
template <class D, class F, class X, class Cut>
constexpr X multiply_short(const F& format, const X& a, const X& b, const Cut& cut) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto half = (m + 1_w) / 2_w;
  const auto field_a = slice(a, e + m - 1_w, m);
  const auto field_b = slice(b, e + m - 1_w, m);
  const Bit one(D::lit(1, 1_w));
  const auto left = cat(one, slice(a, m - 1_w, 0_w));
  const auto right = cat(one, slice(b, m - 1_w, 0_w));
  const auto low = as("product_low", slice(left, m, cut) * slice(right, half - 1_w, 0_w));
  const auto high = as("product_high", left * slice(right, m, half));
  const auto upper_low = slice(low, m + half - cut, half - cut);
  const auto product = as("product_upper", resize(high + upper_low, m + m + 2_w - half));

  const Bit top = sign(product);
  const auto highest_bit = m + m + 1_w - half;
  const auto fraction = select(top, slice(product, highest_bit - 1_w, highest_bit - m),
                               slice(product, highest_bit - 2_w, highest_bit - m - 1_w));
  const auto by_one = slice(cat(field_a, one) + cat(field_b, one), e + 1_w, 1_w);
  const auto by_two = slice(by_one + one, e, 0_w);
  const auto sum = as("exponent", select(top, by_two, by_one));
  const Bit highest = sign(sum);
  const Bit infinite(field_b == D::lit((1 << e) - 1, e));
  const Bit most = as("overflow", Bit((highest & bit_at(sum, e - 1_w)) | infinite));
  return cat(highest, cat(slice(sum, e - 2_w, 0_w), fraction)) | spread(most, e + m);
}

/// Where a bound is to lie: at most the exact distance for near planes, at least that for far ones.
template <class Bit>
struct Bound {
  Bit near;
};

/// (a - b) * c with one normalisation, that of the product. The difference has a guard bit; c is at least 1.
/// A distance below the least normal number is 0.
template <class D, class F, class X, class Y>
constexpr auto fused(const F& format, const X& a, const X& b, const Y& c,
                     const Bound<typename D::bit>& bound) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto half = (m + 1_w) / 2_w;
  const auto w = m + m + 4_w;
  const auto terms = fp_logic::difference_rz<D>(format, a, b);
  const auto zeros = as("leading_zeros", fp_logic::leading_zeros<D>(terms.sum));
  const auto factor = cat(Bit(D::lit(1, 1_w)), slice(c, m - 1_w, 0_w));
  const auto low = as("product_low", terms.sum * slice(factor, half - 1_w, 0_w));
  const auto high = as("product_high", terms.sum * slice(factor, m, half));
  const auto upper = as("product_upper", resize(high + slice(low, m + 2_w + half, half), w - half));
  const auto product = cat(upper, slice(low, half - 1_w, 0_w));
  const auto normalised = as("normalised", fp_logic::shift_left<D>(product, zeros));
  const Bit top = sign(normalised);
  const Bit some = top | bit_at(normalised, w - 2_w);
  const auto fraction =
      select(top, slice(normalised, w - 2_w, w - 1_w - m), slice(normalised, w - 3_w, w - 2_w - m));

  const auto field_c = slice(c, e + m - 1_w, m);
  const auto above = field_c - D::lit((1 << (e - 1)) - 1, e);
  const auto lowered = (terms.exponent + D::lit(1, 1_w)) - zeros;
  const auto exponent = as("exponent", resize((lowered + above) + resize(top, 2_w), e + 3_w));
  const Bit below = sign(exponent) | ~any<D>(slice(exponent, e + 1_w, 0_w));
  const Bit infinite(field_c == D::lit((1 << e) - 1, e));
  const Bit most = Bit(~sign(exponent) & any<D>(slice(exponent, e + 1_w, e))) | infinite;
  const auto pattern =
      cat(as_unsigned(slice(exponent, e - 1_w, 0_w)), fraction) & spread(Bit(some & ~below), e + m);
  return cat(terms.negative, (pattern | spread(most, e + m)) & spread(Bit(some | ~bound.near), e + m));
}

/// A ray's factor for planes of either sign.
template <class Y>
struct Inverses {
  Y of_plus, of_minus;
};

/// Products take a subnormal plane for a larger one. A product that must not grow is 0 then.
template <class D, class F, class X>
constexpr typename D::bit plane_counts(const F& format, const X& plane, const Bound<typename D::bit>& bound) {
  const auto e = format.exponent;
  const auto m = format.fraction;
  const typename D::bit may_grow = sign(plane) ^ ~bound.near;
  return any<D>(slice(plane, e + m - 1_w, m)) | (may_grow & any<D>(slice(plane, m - 1_w, 0_w)));
}

/// plane * inverse - c, both rounded. c is a bound of origin * inverse.
template <class D, class F, class X, class Y>
constexpr auto separate(const F& format, const X& plane, const Inverses<Y>& inverses, const X& c,
                        const Bound<typename D::bit>& bound) {
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto inverse = as("inverse", select(sign(plane), inverses.of_minus, inverses.of_plus));
  const auto product = fp_logic::multiply_rz<D>(format, Y(slice(plane, e + m - 1_w, 0_w)), inverse);
  const auto counted = product & spread(plane_counts<D>(format, plane, bound), e + m);
  return subtract_exact<D>(format, X(cat(sign(plane), counted)), c);
}

/// The same with all bits of the product. c is normal or zero.
template <class D, class F, class X, class Y>
constexpr auto separate_fused(const F& format, const X& plane, const Inverses<Y>& inverses, const X& c,
                              const Bound<typename D::bit>& bound) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto w = m + m + 2_w;
  const auto inverse = as("inverse", select(sign(plane), inverses.of_minus, inverses.of_plus));
  const auto field_i = slice(inverse, e + m - 1_w, m);
  const Bit one(D::lit(1, 1_w));
  const auto product = fp_logic::significand_product(format, cat(one, slice(plane, m - 1_w, 0_w)),
                                                     cat(one, slice(inverse, m - 1_w, 0_w)));
  const Bit top = sign(product);
  const auto above = field_i - D::lit((1 << (e - 1)) - 1, e);
  const Bit counts = plane_counts<D>(format, plane, bound);
  const auto exponent_p = as_signed(((slice(plane, e + m - 1_w, m) + above) + resize(top, 2_w)) &
                                    resize(as_signed(counts), e + 2_w));
  const auto raised = select(top, product, cat(slice(product, w - 2_w, 0_w), D::lit(0, 1_w)));
  const auto p = raised & spread(counts, w);
  const auto uc = fp_logic::unpack<D>(format, c);
  const auto q = cat(uc.significand, D::lit(0, m + 1_w));

  const Bit opposite = as("opposite", ~(sign(plane) ^ uc.sign));
  const auto exponent_c = resize(as_signed(cat(D::lit(0, 2_w), slice(c, e + m - 1_w, m))), e + 2_w);
  const auto ahead = resize(exponent_p - exponent_c, e + 2_w);
  const auto behind = resize(exponent_c - exponent_p, e + 2_w);
  const Bit swap = as("swap", select(opposite, sign(plane), Bit(sign(ahead))));
  const auto gap = as("gap", select(swap, behind, ahead));
  const auto exponent = as("exponent", select(swap, exponent_c, resize(exponent_p, e + 2_w)));
  const auto aligned = align<D>(cat(select(swap, p, q), D::lit(0, 1_w)), as_unsigned(resize(gap, e)));
  const auto first = cat(D::lit(0, 1_w), cat(select(swap, q, p), cat(D::lit(0, 1_w), opposite)));
  const auto second = cat(opposite, cat(aligned ^ spread(opposite, w + 1_w), opposite));
  const auto sum = as("raw_sum", slice(first + second, w + 2_w, 1_w));
  const Bit negative = as("negative", select(opposite, Bit(sign(gap) | sign(sum)), sign(plane)));

  const auto zeros = as("leading_zeros", fp_logic::leading_zeros<D>(sum));
  const auto normalised = as("normalised", fp_logic::shift_left<D>(sum, zeros));
  const auto biased = resize((exponent + D::lit(1, 1_w)) - zeros, e + 3_w);
  const Bit below = sign(biased) | ~any<D>(slice(biased, e + 1_w, 0_w)) | ~sign(normalised);
  const Bit infinite(field_i == D::lit((1 << e) - 1, e));
  const Bit most = Bit(~sign(biased) & any<D>(slice(biased, e + 1_w, e))) | infinite;
  const auto fraction = slice(normalised, w, w + 1_w - m);
  const auto pattern = cat(as_unsigned(slice(biased, e - 1_w, 0_w)), fraction) & spread(Bit(~below), e + m);
  return cat(negative, pattern | spread(most, e + m));
}

}  // namespace slab_forms
}  // namespace hls
}  // namespace hitpipe
