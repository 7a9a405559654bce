// Float operators that round toward zero, for finite numbers. They are smaller than those to nearest
// (fp_logic.hpp): no result is incremented, there are no NaN, and a difference may be one unit of its last
// place too small. What they do with other patterns is defined, but means nothing. Magnitudes have no
// subnormal numbers: exponent field 0 is one more binade, (1 + fraction) 2^-bias, in all patterns but 0.
#pragma once

#include "hls/num/fp_product.hpp"
#include "hls/num/fp_sum.hpp"

namespace hitpipe {
namespace hls {
namespace fp_logic {

/// The two's complement number x shifted right by `distance`, in its own width. What is shifted out is lost.
template <class D, class X, class Distance>
constexpr X shift_out(const X& x, const Distance& distance) {
  // Far enough to shift out all of x, unless distances are never that long.
  const auto bits = min(count_bits(width_of(x)), width_of(distance));
  const auto amount = change_if(bits < width_of(distance), distance, [&](const auto& any_distance) {
    const auto far = any<D>(slice(any_distance, width_of(distance) - 1_w, bits));
    return slice(any_distance, bits - 1_w, 0_w) | spread(far, bits);
  });
  return for_each_level(bits, x, [&](const auto& so_far, const auto& level) {
    const auto by = power_of_two(level);
    const auto moved = cat(spread(typename D::bit(sign(x)), by), slice(so_far, width_of(x) - 1_w, by));
    return select(bit_at(amount, level), moved, so_far);
  });
}

/// A difference before it is normalised: sum * 2^exponent, up to a constant factor. If it is negative,
/// only the sign has a meaning.
template <class Bit, class Exponent, class Sum>
struct Difference {
  Bit negative;
  Exponent exponent;
  Sum sum;
};
template <class Bit, class Exponent, class Sum>
constexpr Difference<Bit, Exponent, Sum> difference_of(const Bit& negative, const Exponent& exponent,
                                                       const Sum& sum) {
  return {negative, exponent, sum};
}

/// a - b. The sum has a carry, M + 1 bits and a guard bit. It is exact if the exponents differ by 1 at most;
/// else it is too small by a guard bit at most.
template <class D, class F, class X>
constexpr auto difference_rz(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto ua = unpack<D>(format, a);
  const auto ub = unpack<D>(format, b);
  const Bit opposite = as("opposite", ~(ua.sign ^ ub.sign));  // a and -b
  const auto ahead = ua.exponent - ub.exponent;
  const auto behind = ub.exponent - ua.exponent;
  // Where a and b have one sign, that sign says which has to be the larger one. Magnitudes are not compared.
  const Bit swap = as("swap", select(opposite, ua.sign, Bit(sign(ahead))));
  const auto gap = as("gap", select(swap, behind, ahead));
  const auto distance = as("distance", as_unsigned(resize(gap, e)));
  const auto exponent = as("exponent", select(swap, ub.exponent, ua.exponent));
  const auto larger = as("larger", select(swap, ub.significand, ua.significand));
  const auto smaller = as("smaller", select(swap, ua.significand, ub.significand));

  const auto guarded = cat(smaller, D::lit(0, 1_w));
  const auto term = cat(opposite, guarded ^ spread(opposite, m + 2_w));
  const auto aligned = as("aligned", shift_out<D>(term, distance));
  // The complement of the second term lacks 1. Where bits may be lost it stays so, which borrows for them.
  // Else a bit below both terms adds it.
  const Bit lost = any<D>(slice(distance, e - 1_w, 1_w));
  const Bit completed = as("completed", Bit(opposite & ~lost));
  const auto first = cat(resize(larger, m + 2_w), cat(D::lit(0, 1_w), completed));
  const auto sum = as("raw_sum", slice(first + cat(aligned, completed), m + 3_w, 1_w));
  const Bit negative = as("negative", select(opposite, Bit(sign(gap) | sign(sum)), ua.sign));
  return difference_of(negative, exponent, sum);
}

/// a - b for |a - b| below the largest number. A normal result is at most a - b, and at most one unit of its
/// last place less. A result with exponent field 0 is exact from 2^-bias on; a smaller difference becomes
/// larger. A difference of 0 gives 0, and +0 unless a is -0 and b is +0. If a < b, only the sign bit has a
/// meaning.
template <class D, class F, class X>
constexpr X subtract_rz(const F& format, const X& a, const X& b) {
  using Bit = typename D::bit;
  const auto e = format.exponent;
  const auto m = format.fraction;
  const auto difference = difference_rz<D>(format, a, b);
  const auto zeros = as("leading_zeros", leading_zeros<D>(difference.sum));
  const auto normalised = as("normalised", shift_left<D>(difference.sum, zeros));
  // The top bit of the sum is one place above the top bit of the significands. After the shift it is 0 only
  // in zero.
  const auto field = as("field", (difference.exponent + D::lit(1, 1_w)) - zeros);
  const Bit counts = sign(normalised) & ~sign(field);
  return cat(difference.negative, cat(as_unsigned(slice(field, e - 1_w, 0_w)) & spread(counts, e),
                                      slice(normalised, m + 1_w, 2_w)));
}

/// The product of two numbers without their signs. Both are read as normal numbers: a pattern with exponent
/// field 0 counts as (1 + fraction) 2^-bias, which is not less than the number that it stands for. b is at
/// least 1. If b is infinite or the product is 2^(bias+2) or more, all bits of the result are 1. Patterns
/// of the highest exponent also stand for finite numbers here, so patterns are in the order of the products.
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
