// The integer slabs test of section 6.2.2, figures 7.4 to 7.6: does a ray meet a box, in n-bit coordinates?
// It is conservative: it may say HIT too often but never misses. The floor and ceil IRDVCs are chosen so that
// every interval can only grow. All products lose equally many low bits, which keeps the order of distances.
// Widths: differences n bits (the ranges of the operands leave room for the sign), products 2n, intervals t.
#pragma once

#include "hls/box/box_hit.hpp"
#include "hls/box/format.hpp"
#include "hls/box/int_slabs_operands.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe {
namespace hls {
namespace int_slabs {
/// Operands of the two multipliers of one axis: end of stage 1, figure 7.4.
template <class Coord>
struct SlabFactors {
  Coord d_near, d_far;    ///< origin to near and far plane
  Coord ir_near, ir_far;  ///< the IRDVC bound that errs outward for each
};

/// Subtracts the origin and chooses operands in the three steps of section 6.2.2.
template <class F, class Coord>
constexpr SlabFactors<Coord> slab_factors(const F& format, char axis, const Coord& origin,
                                          const Coord& plane_min, const Coord& plane_max,
                                          const Coord& ir_floor, const Coord& ir_ceil) {
  const Coord d0 = as("d0", axis, resize(plane_min - origin, format.coord));
  const Coord d1 = as("d1", axis, resize(plane_max - origin, format.coord));
  const auto backward = sign(ir_floor);

  SlabFactors<Coord> f;
  f.d_near = as("d_near", axis, select(backward, d1, d0));
  f.d_far = as("d_far", axis, select(backward, d0, d1));
  f.ir_near = as("ir_near", axis, select(sign(f.d_near), ir_ceil, ir_floor));
  f.ir_far = as("ir_far", axis, select(sign(f.d_far), ir_floor, ir_ceil));
  return f;
}

/// Distances at which the ray enters and leaves a slab.
template <class Interval>
struct IntSlab {
  Interval near, far;
};

/// The upper t bits of each product, without bit 2n-1, which repeats the sign. Figures 7.4, 7.5.
template <class Interval, class F, class Coord>
constexpr IntSlab<Interval> int_slab(const F& format, char axis, const SlabFactors<Coord>& f) {
  const auto high = format.product() - 1_w;
  const auto low = format.trimmed();
  return {as("it_near", axis, as_signed(slice(f.d_near * f.ir_near, high, low))),
          as("it_far", axis, as_signed(slice(f.d_far * f.ir_far, high, low)))};
}

/// The last stage, figure 7.6: the three intervals and the ray's own [0, irlen] have a point in common.
template <class Bit, class Interval>
constexpr Bit slabs_overlap(const IntSlab<Interval>& x, const IntSlab<Interval>& y,
                            const IntSlab<Interval>& z, const Interval& irlen, const Bit& rinf) {
  const Interval near_xy = as("it_near_xy", select(Bit(x.near < y.near), y.near, x.near));
  const Interval near = as("it_near", select(Bit(near_xy < z.near), z.near, near_xy));
  const Interval far_xy = as("it_far_xy", select(Bit(y.far < x.far), y.far, x.far));
  const Interval far = as("it_far", select(Bit(z.far < far_xy), z.far, far_xy));

  const Bit behind = sign(far);
  const Bit apart = as("apart", Bit(far < near));
  const Bit beyond = as("beyond", Bit(irlen < near));
  return as("overlap", (~behind & ~apart) & (~beyond | rinf));
}

struct IntSlabs {
  static constexpr const char* name = "int_slabs";
  static constexpr const char* summary = "integer slabs test, figures 7.4-7.6";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  using Bits = IntBits;
  using BuiltIn = FormatList<IntFormat<24, 24>, IntFormat<20, 24>, IntFormat<16, 16>, IntFormat<12, 12>>;
  template <class D, class F>
  using Operands = IntSlabsOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const IntSlabsOperands<D, F>& in) {
    using Interval = typename F::template Interval<D>;
    const auto x = slab_factors(format, 'x', in.irx, in.ixmin, in.ixmax, in.iri_floor, in.iri_ceil);
    const auto y = slab_factors(format, 'y', in.iry, in.iymin, in.iymax, in.irj_floor, in.irj_ceil);
    const auto z = slab_factors(format, 'z', in.irz, in.izmin, in.izmax, in.irk_floor, in.irk_ceil);
    return {slabs_overlap(int_slab<Interval>(format, 'x', x), int_slab<Interval>(format, 'y', y),
                          int_slab<Interval>(format, 'z', z), in.irlen, in.rinf)};
  }
};

}  // namespace int_slabs

using int_slabs::IntSlabs;

}  // namespace hls
}  // namespace hitpipe
