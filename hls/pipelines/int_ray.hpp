// The door of the integer world as a unit (docs/integer_world.md): a binary32 ray becomes an integer ray, by
// exact rounding, as ref::int_ray and ref::major_ray define it. |x| is the mantissa m, which has 24 bits,
// times a power of two. G m is 2^(n-2) m - m.
//   origin    G m shifted right, plus the bit behind the point: the nearest integer, ties up. Of a negative
//             number G m - 1 is shifted, so that ties go up there too, and the sum is negated.
//   slope     S + 2 bits of |D_k| / |D_M| by mantissas, then shifted right by the difference of the exponents
//             and rounded. The mantissas need no normalisation: of subnormal directions too, the quotient is
//             below 2.
//   bounds    p bits of 2^(S+1) / s with s shifted left until it has S + 1 bits. Only powers of two divide
//             2^(S+p), so the upper bound is one more, unless s is a power of two.
//   length    G times the product of two mantissas, shifted right. Bits above the word mean the largest.
// Both quotients are made bit by bit. Each step is one subtraction, and all are of the same width, so a unit
// with a long interval (--ii) has few subtractors. Error is 1 for an origin outside the cube, a direction
// that is 0, infinite or NaN, and a length that is NaN or negative; -0 is not negative.
#pragma once

#include <cstdint>

#include "hls/box/format.hpp"
#include "hls/num/fp_parts.hpp"
#include "hls/num/levels.hpp"
#include "hls/pipelines/ray_axes_parts.hpp"
#include "hls/world/ray_operands.hpp"

namespace hitpipe {
namespace hls {
namespace int_ray {

// binary32.
constexpr Width<8> exponent_bits{};
constexpr Width<24> mantissa_bits{};

template <class X>
constexpr auto exponent_field(const X& x) {
  return slice(x, 30_w, 23_w);
}
template <class X>
constexpr auto fraction_field(const X& x) {
  return slice(x, 22_w, 0_w);
}
template <class X>
constexpr auto magnitude(const X& x) {
  return slice(x, 30_w, 0_w);
}

/// |x| is mantissa 2^(exponent - 150).
template <class M, class E>
struct Parts {
  M mantissa;
  E exponent;
};
template <class M, class E>
constexpr Parts<M, E> make_parts(const M& mantissa, const E& exponent) {
  return {mantissa, exponent};
}
template <class D, class X>
constexpr auto parts_of(const X& x) {
  using Bit = typename D::bit;
  const Bit normal = any<D>(exponent_field(x));
  return make_parts(cat(normal, fraction_field(x)), exponent_field(x) | resize(Bit(~normal), exponent_bits));
}

template <class X>
constexpr X inverted(const X& x) {
  return ~x;
}

/// All bits are 1.
template <class D, class X>
constexpr typename D::bit full(const X& x) {
  return ~any<D>(inverted(x));
}

/// x, or the other if the bit is 1.
template <class D, class X>
constexpr X conditionally_inverted(const typename D::bit& bit, const X& x) {
  return x ^ spread(bit, width_of(x));
}

/// x 2^-amount, rounded down, for any amount.
template <class D, class X, class Amount>
constexpr X shifted_right(const X& x, const Amount& amount) {
  using Bit = typename D::bit;
  const auto w = width_of(x);
  const auto levels = count_bits(w);
  const X moved = for_each_level(levels, x, [&](const X& so_far, const auto& level) {
    const auto by = power_of_two(level);
    const X lower = cat(D::lit(0, by), slice(so_far, w - 1_w, by));
    return select(Bit(bit_at(amount, level)), lower, so_far);
  });
  const Bit beyond = any<D>(slice(amount, width_of(amount) - 1_w, levels));
  return select(beyond, X(D::lit(0, w)), moved);
}

/// (G m - one) 2^-cut, rounded down, without a sign. m is at least 1 if one is.
template <class D, class F, class M, class Cut>
constexpr auto scaled(const F& format, const M& m, const typename D::bit& one, const Cut& cut) {
  using Bit = typename D::bit;
  const auto above = format.coord - 2_w;
  const auto raised = cat(m, D::lit(0, above));
  const auto high = width_of(raised) - cut;
  const Bit borrow(cat(slice(raised, cut - 1_w, 0_w), D::lit(0, 1_w)) < cat(slice(m, cut - 1_w, 0_w), one));
  // A 1 below makes the borrow, so it is one subtractor.
  const auto minuend = cat(slice(raised, width_of(raised) - 1_w, cut), D::lit(0, 1_w));
  const auto subtrahend = cat(slice(m, width_of(m) - 1_w, cut), borrow);
  return as_unsigned(slice(minuend - resize(subtrahend, high + 1_w), high, 1_w));
}

/// floor(2^(count-1) x / y) for x < 2 y. All bits are 1 if x = 2 y. The division does not restore: a negative
/// remainder -r is kept as r - 1, which is ~(-r), and y is subtracted from its double in the same way.
template <class X, class Q, class Bit>
struct Division {
  X rest;        ///< twice the remainder, or its inversion
  Bit inverted;  ///< the remainder is negative
  Q quotient;
};
template <class D, class X, class Count>
constexpr auto quotient(const X& x, const X& y, const Count& count) {
  using Bit = typename D::bit;
  using Q = Word<D, Count>;
  using So = Division<X, Q, Bit>;
  const auto w = width_of(x);
  const So first{x, Bit(D::lit(0, 1_w)), Q(D::lit(0, count))};
  const auto step = [&](const So& so_far, const auto& /*level*/) {
    const X difference = as_unsigned(resize(so_far.rest - y, w));
    const Bit turns = sign(difference);
    const Bit negative = so_far.inverted ^ turns;
    const auto rest = conditionally_inverted<D>(turns, slice(difference, w - 2_w, 0_w));
    return So{cat(rest, negative), negative, cat(slice(so_far.quotient, count - 2_w, 0_w), Bit(~negative))};
  };
  return for_each_level(count, first, step).quotient;
}

/// floor(G 2^g x + 1/2) for |x| <= 1.
template <class D, class F, class X>
constexpr typename F::template Point<D> on_grid(const F& format, const X& x) {
  using Bit = typename D::bit;
  const Bit negative = sign(x);
  // Subnormal numbers are shifted out, so their leading bit does not matter.
  const auto mantissa = cat(D::lit(1, 1_w), fraction_field(x));
  const auto twice = scaled<D>(format, mantissa, negative, 22_w - format.finer);
  const auto down = inverted(slice(x, 29_w, 23_w));  // 127 - exponent
  const auto shifted = shifted_right<D>(twice, down);
  const auto whole = cat(D::lit(0, 1_w), slice(shifted, width_of(shifted) - 1_w, 1_w));
  const Bit half = bit_at(shifted, 0_w);
  return as_signed(resize(conditionally_inverted<D>(negative, whole) + Bit(half ^ negative), format.point()));
}

/// floor(2^S |D_k| / |D_M| + 1/2).
template <class D, class F, class P>
constexpr typename F::template Slope<D> slope(const F& format, const P& of, const P& major) {
  using X = typename F::template Remainder<D>;
  const X dividend = resize(of.mantissa, format.remainder());
  const X divisor = resize(major.mantissa, format.remainder());
  const auto bits = quotient<D>(dividend, divisor, format.slope + 2_w);
  const auto down = resize(as_unsigned(major.exponent - of.exponent), exponent_bits);
  const auto shifted = shifted_right<D>(bits, down);
  return resize(slice(shifted, format.slope + 1_w, 1_w) + bit_at(shifted, 0_w), format.slope + 1_w);
}

/// mantissa_low 2^exponent <= 2^(p-1) 2^S / s <= mantissa_high 2^exponent.
template <class M, class E>
struct Bounds {
  M low, high;
  E exponent;
};
template <class D, class F>
constexpr auto bounds(const F& format, const typename F::template Slope<D>& s) {
  using Bit = typename D::bit;
  using Mantissa = typename F::template Mantissa<D>;
  using Exponent = typename F::template Exponent<D>;
  using X = typename F::template Remainder<D>;
  const auto w = format.remainder();
  const auto p = format.mantissa;
  const auto zeros = fp_logic::leading_zeros<D>(s);
  const auto raised = fp_logic::shift_left<D>(s, zeros);
  const Bit power = ~any<D>(slice(raised, format.slope - 1_w, 0_w));
  const Bit zero = ~Bit(sign(raised));
  const X dividend = D::lit(std::int64_t{2} << format.slope, w);
  const X divisor = resize(raised, w);
  const Mantissa bits = quotient<D>(dividend, divisor, p);

  // All bits are 1 also if s is a power of two. Else the upper bound would be 2, so both are halved.
  const Bit ones = full<D>(bits) | zero;
  const auto exponent = resize(as_unsigned(zeros - Bit(~ones)), width_of(zeros));
  const auto largest = format.point() - 1_w;
  const Bit beyond = Bit(D::lit(largest, 6_w) < exponent) & ~zero;
  const Mantissa top = cat(D::lit(1, 1_w), D::lit(0, p - 1_w));
  const Mantissa next = resize(bits + D::lit(1, 1_w), p);
  const Mantissa all = inverted(D::lit(0, p));
  const Mantissa low = select(ones, select(power, top, inverted(top)), bits);
  const Mantissa high = select(ones, top, next);
  Bounds<Mantissa, Exponent> out;
  out.low = select(beyond, all, low);
  out.high = select(beyond, all, high);
  out.exponent = select(Bit(beyond | zero), Exponent(D::lit(largest, format.exponent())),
                        Exponent(resize(exponent, format.exponent())));
  return out;
}

/// floor(length |D_M| G 2^(g+F)), at most the largest.
template <class D, class F, class P>
constexpr typename F::template Length<D> length(const F& format, const P& of, const P& major) {
  using Bit = typename D::bit;
  const auto w = format.distance();
  const auto mantissas = as("length_product", of.mantissa * major.mantissa);
  const auto full_length =
      scaled<D>(format, mantissas, Bit(D::lit(0, 1_w)), 45_w - format.finer - format.fraction);
  // The product is to be shifted right by 255 - exponents bits. From 256 on it is larger than any length.
  const auto exponents = of.exponent + major.exponent;
  const auto down = inverted(slice(exponents, 7_w, 0_w));
  const auto shifted = shifted_right<D>(full_length, down);
  const Bit beyond = Bit(sign(exponents)) | any<D>(slice(shifted, width_of(shifted) - 1_w, w));
  return slice(shifted, w - 1_w, 0_w) | spread(beyond, w);
}

struct IntRay {
  static constexpr const char* name = "int_ray";
  static constexpr const char* summary = "integer rays of float rays, exactly";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = ray_kind;
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = RayBits;
  using BuiltIn = FormatList<>;
  template <class D, class F>
  using Operands = IntRayOperands<D, F>;
  template <class D, class F>
  using Results = IntRayResults<D, F>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const IntRayOperands<D, F>& in) {
    using Bit = typename D::bit;
    const auto x = magnitude(in.dx.bits);
    const auto y = magnitude(in.dy.bits);
    const auto z = magnitude(in.dz.bits);
    const Bit y_first = as("y_first", Bit(x < y));
    const Bit z_first = as("z_first", Bit(select(y_first, y, x) < z));
    Results<D, F> out;
    out.major_y = y_first & ~z_first;
    out.major_z = z_first;

    const auto direction = to_ray_axes(out, in.dx.bits, in.dy.bits, in.dz.bits);
    out.back_m = Bit(sign(direction.m));
    out.back_a = Bit(sign(direction.a)) & any<D>(magnitude(direction.a));
    out.back_b = Bit(sign(direction.b)) & any<D>(magnitude(direction.b));
    const auto major = parts_of<D>(direction.m);
    out.s_a = as("slope", 'a', slope<D>(format, parts_of<D>(direction.a), major));
    out.s_b = as("slope", 'b', slope<D>(format, parts_of<D>(direction.b), major));
    const auto a = bounds<D>(format, out.s_a);
    const auto b = bounds<D>(format, out.s_b);
    out.floor_a = a.low;
    out.ceil_a = a.high;
    out.exp_a = a.exponent;
    out.floor_b = b.low;
    out.ceil_b = b.high;
    out.exp_b = b.exponent;

    const auto origin = to_ray_axes(out, on_grid<D>(format, in.ox.bits), on_grid<D>(format, in.oy.bits),
                                    on_grid<D>(format, in.oz.bits));
    out.origin_m = origin.m;
    out.origin_a = origin.a;
    out.origin_b = origin.b;
    out.t_end = length<D>(format, parts_of<D>(in.len.bits), major);

    const Bit outside = beyond_one<D>(in.ox.bits) | beyond_one<D>(in.oy.bits) | beyond_one<D>(in.oz.bits);
    const Bit no_direction = full<D>(exponent_field(direction.m)) | ~any<D>(magnitude(direction.m));
    const Bit nan = full<D>(exponent_field(in.len.bits)) & any<D>(fraction_field(in.len.bits));
    const Bit no_length = nan | (Bit(sign(in.len.bits)) & any<D>(magnitude(in.len.bits)));
    out.error = as("error", Bit(outside | no_direction | no_length));
    return out;
  }

 private:
  /// |x| > 1, or NaN.
  template <class D, class X>
  static constexpr typename D::bit beyond_one(const X& x) {
    return typename D::bit(D::lit(0x3F800000, 31_w) < magnitude(x));
  }
};

}  // namespace int_ray

using int_ray::IntRay;

}  // namespace hls
}  // namespace hitpipe
