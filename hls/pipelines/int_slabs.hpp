// The integer slabs test of section 6.2.2, figures 7.4 to 7.6: does a ray meet a box, in n-bit coordinates?
// Conservative: floor and ceil IRDVCs are chosen so that every interval can only grow, and dropping low
// product bits (2n-1 down to t) keeps the order of what it compares. Says HIT too often, never too seldom.
// Widths: differences n bits (the operands' ranges leave room for the sign), products 2n, intervals t.
#pragma once

#include "hls/box/arithmetic.hpp"
#include "hls/box/int_format.hpp"
#include "hls/box/int_slabs_operands.hpp"
#include "hls/num/domain.hpp"

namespace hitpipe::hls {

/// Operands of one axis' two multipliers: end of stage 1, figure 7.4.
template <class Coord>
struct SlabFactors {
  Coord d_near, d_far;    ///< origin to near and far plane
  Coord ir_near, ir_far;  ///< the IRDVC bound that errs outward for each
};

/// Subtract the origin and choose operands in the three steps of section 6.2.2.
template <class Coord>
constexpr SlabFactors<Coord> slab_factors(char axis, const Coord& origin, const Coord& plane_min,
                                          const Coord& plane_max, const Coord& ir_floor,
                                          const Coord& ir_ceil) {
  constexpr int n = Coord::width;
  const Coord d0 = as("d0", axis, resize<n>(plane_min - origin));
  const Coord d1 = as("d1", axis, resize<n>(plane_max - origin));
  const auto backward = slice<n - 1, n - 1>(ir_floor);

  SlabFactors<Coord> f;
  f.d_near = as("d_near", axis, select(backward, d1, d0));
  f.d_far = as("d_far", axis, select(backward, d0, d1));
  f.ir_near = as("ir_near", axis, select(slice<n - 1, n - 1>(f.d_near), ir_ceil, ir_floor));
  f.ir_far = as("ir_far", axis, select(slice<n - 1, n - 1>(f.d_far), ir_floor, ir_ceil));
  return f;
}

/// A distance, its low bits dropped: bits 2n-2 down to 2n-1-t of the product (bit 2n-1 repeats the sign).
template <class Interval, class Coord>
constexpr Interval slab_distance(const char* name, char axis, const Coord& d, const Coord& ir) {
  constexpr int product = 2 * Coord::width - 1;
  return as(name, axis, Interval(slice<product - 1, product - Interval::width>(d * ir)));
}

/// Stage 5, figure 7.6: the three intervals and the ray's own [0, irlen] have a point in common.
template <class Bit, class Interval>
constexpr Bit slabs_overlap(const Interval& near_x, const Interval& far_x, const Interval& near_y,
                            const Interval& far_y, const Interval& near_z, const Interval& far_z,
                            const Interval& irlen, const Bit& rinf) {
  constexpr int sign = Interval::width - 1;
  const Interval near_xy = as("it_near_xy", select(Bit(near_x < near_y), near_y, near_x));
  const Interval near = as("it_near", select(Bit(near_xy < near_z), near_z, near_xy));
  const Interval far_xy = as("it_far_xy", select(Bit(far_y < far_x), far_y, far_x));
  const Interval far = as("it_far", select(Bit(far_z < far_xy), far_z, far_xy));

  const Bit behind = slice<sign, sign>(far);
  const Bit apart = as("apart", Bit(far < near));
  const Bit beyond = as("beyond", Bit(irlen < near));
  return as("overlap", Bit((~behind & ~apart) & (~beyond | rinf)));
}

struct IntSlabs {
  static constexpr const char* name = "int_slabs";
  static constexpr const char* summary = "integer slabs test, figures 7.4-7.6";
  static constexpr Arithmetic arithmetic = Arithmetic::integer;
  static constexpr bool conservative = true;
  using Bits = IntBits;

  template <class D, class F>
  using Operands = IntSlabsOperands<D, F>;

  template <class D, class F>
  static constexpr typename D::bit hit(const Operands<D, F>& in) {
    using Interval = typename Operands<D, F>::interval;
    const auto x = slab_factors('x', in.irx, in.ixmin, in.ixmax, in.iri_floor, in.iri_ceil);
    const auto y = slab_factors('y', in.iry, in.iymin, in.iymax, in.irj_floor, in.irj_ceil);
    const auto z = slab_factors('z', in.irz, in.izmin, in.izmax, in.irk_floor, in.irk_ceil);
    return slabs_overlap<typename D::bit>(slab_distance<Interval>("it_near", 'x', x.d_near, x.ir_near),
                                          slab_distance<Interval>("it_far", 'x', x.d_far, x.ir_far),
                                          slab_distance<Interval>("it_near", 'y', y.d_near, y.ir_near),
                                          slab_distance<Interval>("it_far", 'y', y.d_far, y.ir_far),
                                          slab_distance<Interval>("it_near", 'z', z.d_near, z.ir_near),
                                          slab_distance<Interval>("it_far", 'z', z.d_far, z.ir_far), in.irlen,
                                          in.rinf);
  }
};

}  // namespace hitpipe::hls
