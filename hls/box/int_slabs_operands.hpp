// The operands of the integer slabs unit: the input latches of figure 7.1, set up by section 6.2.1.
//   D  a value domain;  F  the format, an IntFormat<n, t> or IntBits
#pragma once

#include "hls/box/int_format.hpp"

namespace hitpipe {
namespace hls {

/// Calls visit(Operand, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct IntSlabsOperands {
  using coord = typename F::template Coord<D>;
  using interval = typename F::template Interval<D>;
  using bit = typename D::bit;

  coord irx, iry, irz;        ///< ray origin on the grid, |value| <= 2^(n-2)-1
  interval irlen;             ///< trimmed ray length, >= 0
  coord iri_floor, iri_ceil;  ///< bounds of the scaled IRDVC of x, |value| <= 2^(n-1)-1
  coord irj_floor, irj_ceil;  ///< of y
  coord irk_floor, irk_ceil;  ///< of z
  bit rinf;                   ///< 1: the ray has no end, irlen is ignored
  coord ixmin, ixmax;         ///< box on the grid, rounded outward, |value| <= 2^(n-2)
  coord iymin, iymax;
  coord izmin, izmax;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(format.point("irx", Role::origin, Axis::x), self.irx);
    visit(format.point("iry", Role::origin, Axis::y), self.iry);
    visit(format.point("irz", Role::origin, Axis::z), self.irz);
    visit(format.length("irlen"), self.irlen);
    visit(format.component("iri_floor", Role::inverse_low, Axis::x), self.iri_floor);
    visit(format.component("iri_ceil", Role::inverse_high, Axis::x), self.iri_ceil);
    visit(format.component("irj_floor", Role::inverse_low, Axis::y), self.irj_floor);
    visit(format.component("irj_ceil", Role::inverse_high, Axis::y), self.irj_ceil);
    visit(format.component("irk_floor", Role::inverse_low, Axis::z), self.irk_floor);
    visit(format.component("irk_ceil", Role::inverse_high, Axis::z), self.irk_ceil);
    visit(flag_operand("rinf", Role::endless), self.rinf);
    visit(format.plane("ixmin", Role::plane_low, Axis::x), self.ixmin);
    visit(format.plane("ixmax", Role::plane_high, Axis::x), self.ixmax);
    visit(format.plane("iymin", Role::plane_low, Axis::y), self.iymin);
    visit(format.plane("iymax", Role::plane_high, Axis::y), self.iymax);
    visit(format.plane("izmin", Role::plane_low, Axis::z), self.izmin);
    visit(format.plane("izmax", Role::plane_high, Axis::z), self.izmax);
  }
};

}  // namespace hls
}  // namespace hitpipe
