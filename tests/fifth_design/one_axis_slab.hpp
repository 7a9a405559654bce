// A design of a user's own: does a ray without end, moving towards +x, meet the slab xmin <= x <= xmax before
// its length ends? Enough to have a subtractor, a multiplier, a comparator, a multiplexer and a gate.
#pragma once

#include "hls/box/arithmetic.hpp"
#include "hls/box/int_format.hpp"
#include "hls/num/domain.hpp"

namespace hitpipe::hls {

template <class D, class F>
struct OneAxisSlabOperands {
  using coord = typename D::template sint<F::coord>;
  using interval = typename D::template sint<F::interval>;
  using bit = typename D::bit;

  coord irx, iri, ixmin, ixmax;
  interval irlen;
  bit from_above;

  template <class Self, class Visit>
  static constexpr void for_each(Self& self, Visit&& visit) {
    visit(F::bits.point("irx", Role::origin, Axis::x), self.irx);
    visit(F::bits.component("iri", Role::inverse, Axis::x), self.iri);
    visit(F::bits.plane("ixmin", Role::plane_low, Axis::x), self.ixmin);
    visit(F::bits.plane("ixmax", Role::plane_high, Axis::x), self.ixmax);
    visit(F::bits.length("irlen"), self.irlen);
    visit(flag_operand("from_above", Role::other), self.from_above);
  }
};

struct OneAxisSlab {
  static constexpr const char* name = "one_axis_slab";
  static constexpr const char* summary = "one slab, for a test";
  static constexpr Arithmetic arithmetic = Arithmetic::integer;

  template <class D, class F>
  using Operands = OneAxisSlabOperands<D, F>;

  template <class D, class F>
  static constexpr typename D::bit hit(const Operands<D, F>& in) {
    using Bit = typename D::bit;
    using Interval = typename Operands<D, F>::interval;
    const auto plane = as("plane", select(in.from_above, in.ixmax, in.ixmin));
    const auto distance = as("distance", resize<F::coord>(plane - in.irx));
    const auto product = distance * in.iri;
    const auto t = as("t", Interval(slice<F::product - 1, F::trimmed>(product)));
    const Bit behind = slice<F::interval - 1, F::interval - 1>(t);
    return as("meets", Bit(~Bit(in.irlen < t) & ~behind));
  }
};

}  // namespace hitpipe::hls
