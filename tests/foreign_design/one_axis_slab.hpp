// A design of a user's own: does a ray without end, moving towards +x, meet the slab xmin <= x <= xmax before
// its length ends? Enough to have a subtractor, a multiplier, a comparator, a multiplexer and a gate.
#pragma once

#include "hls/box/box_hit.hpp"
#include "hls/box/format.hpp"
#include "hls/box/int_format.hpp"
#include "hls/num/bits.hpp"

namespace hitpipe::hls {

template <class D, class F>
struct OneAxisSlabOperands {
  using coord = typename F::template Coord<D>;
  using interval = typename F::template Interval<D>;
  using bit = typename D::bit;

  coord irx, iri, ixmin, ixmax;
  interval irlen;
  bit from_above;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(format.point("irx", Role::origin, Axis::x), self.irx);
    visit(format.component("iri", Role::inverse, Axis::x), self.iri);
    visit(format.plane("ixmin", Role::plane_low, Axis::x), self.ixmin);
    visit(format.plane("ixmax", Role::plane_high, Axis::x), self.ixmax);
    visit(format.length("irlen"), self.irlen);
    visit(flag_operand("from_above", Role::other), self.from_above);
  }
};

struct OneAxisSlab {
  static constexpr const char* name = "one_axis_slab";
  static constexpr const char* summary = "one slab, for a test";
  static constexpr bool conservative = false;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;

  using Bits = IntBits;
  using BuiltIn = FormatList<>;
  template <class D, class F>
  using Operands = OneAxisSlabOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const OneAxisSlabOperands<D, F>& in) {
    using Bit = typename D::bit;
    const auto plane = as("plane", select(in.from_above, in.ixmax, in.ixmin));
    const auto distance = as("distance", resize(plane - in.irx, format.coord));
    const auto product = distance * in.iri;
    const auto t = as("t", as_signed(slice(product, format.product() - 1_w, format.trimmed())));
    const Bit behind = sign(t);
    return {as("meets", ~Bit(in.irlen < t) & ~behind)};
  }
};

}  // namespace hitpipe::hls
