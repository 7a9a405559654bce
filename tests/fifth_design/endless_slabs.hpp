// A design of a user's own: the integer slabs test of a ray that never ends. It has no operand for the ray's
// length, so it reports every box ahead of the origin that int_slabs would report for an endless ray.
// Conservative, as int_slabs.
#pragma once

#include "hls/pipelines/int_slabs.hpp"

namespace hitpipe::hls {

/// Calls visit(Operand, field) for every port. `Self` may be const.
template <class D, class F>
struct EndlessSlabsOperands {
  using coord = typename F::template Coord<D>;

  coord irx, iry, irz;  ///< as those of IntSlabsOperands
  coord iri_floor, iri_ceil;
  coord irj_floor, irj_ceil;
  coord irk_floor, irk_ceil;
  coord ixmin, ixmax;
  coord iymin, iymax;
  coord izmin, izmax;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(format.point("irx", Role::origin, Axis::x), self.irx);
    visit(format.point("iry", Role::origin, Axis::y), self.iry);
    visit(format.point("irz", Role::origin, Axis::z), self.irz);
    visit(format.component("iri_floor", Role::inverse_low, Axis::x), self.iri_floor);
    visit(format.component("iri_ceil", Role::inverse_high, Axis::x), self.iri_ceil);
    visit(format.component("irj_floor", Role::inverse_low, Axis::y), self.irj_floor);
    visit(format.component("irj_ceil", Role::inverse_high, Axis::y), self.irj_ceil);
    visit(format.component("irk_floor", Role::inverse_low, Axis::z), self.irk_floor);
    visit(format.component("irk_ceil", Role::inverse_high, Axis::z), self.irk_ceil);
    visit(format.plane("ixmin", Role::plane_low, Axis::x), self.ixmin);
    visit(format.plane("ixmax", Role::plane_high, Axis::x), self.ixmax);
    visit(format.plane("iymin", Role::plane_low, Axis::y), self.iymin);
    visit(format.plane("iymax", Role::plane_high, Axis::y), self.iymax);
    visit(format.plane("izmin", Role::plane_low, Axis::z), self.izmin);
    visit(format.plane("izmax", Role::plane_high, Axis::z), self.izmax);
  }
};

struct EndlessSlabs {
  static constexpr const char* name = "endless_slabs";
  static constexpr const char* summary = "integer slabs test of rays without an end";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  using Shares = IntSlabs;

  using Bits = IntBits;
  using BuiltIn = FormatList<>;
  template <class D, class F>
  using Operands = EndlessSlabsOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const EndlessSlabsOperands<D, F>& in) {
    using Bit = typename D::bit;
    using Interval = typename F::template Interval<D>;
    const auto slab = [&](char axis, const auto& origin, const auto& low, const auto& high, const auto& floor,
                          const auto& ceil) {
      return int_slabs::int_slab<Interval>(
          format, axis, int_slabs::slab_factors(format, axis, origin, low, high, floor, ceil));
    };
    const auto x = slab('x', in.irx, in.ixmin, in.ixmax, in.iri_floor, in.iri_ceil);
    const auto y = slab('y', in.iry, in.iymin, in.iymax, in.irj_floor, in.irj_ceil);
    const auto z = slab('z', in.irz, in.izmin, in.izmax, in.irk_floor, in.irk_ceil);
    const Interval near_xy = as("near_xy", select(Bit(x.near < y.near), y.near, x.near));
    const Interval near = as("near", select(Bit(near_xy < z.near), z.near, near_xy));
    const Interval far_xy = as("far_xy", select(Bit(y.far < x.far), y.far, x.far));
    const Interval far = as("far", select(Bit(z.far < far_xy), z.far, far_xy));
    return {as("ahead", ~sign(far) & ~Bit(far < near))};
  }
};

}  // namespace hitpipe::hls
