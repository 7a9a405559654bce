// What the integer slabs unit receives: figure 7.1's input latches, prepared as section 6.2.1 says.
//   F  an IntFormat<n, t>;  D  a value domain
#pragma once

#include "hls/box/operand.hpp"

namespace hitpipe::hls {

/// Calls visit(Operand, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct IntSlabsOperands {
  using coord = typename D::template sint<F::coord>;
  using interval = typename D::template sint<F::interval>;
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
  static constexpr void for_each(Self& self, Visit&& visit) {
    visit(F::bits.point("irx", Role::origin, Axis::x), self.irx);
    visit(F::bits.point("iry", Role::origin, Axis::y), self.iry);
    visit(F::bits.point("irz", Role::origin, Axis::z), self.irz);
    visit(F::bits.length("irlen"), self.irlen);
    visit(F::bits.component("iri_floor", Role::inverse_low, Axis::x), self.iri_floor);
    visit(F::bits.component("iri_ceil", Role::inverse_high, Axis::x), self.iri_ceil);
    visit(F::bits.component("irj_floor", Role::inverse_low, Axis::y), self.irj_floor);
    visit(F::bits.component("irj_ceil", Role::inverse_high, Axis::y), self.irj_ceil);
    visit(F::bits.component("irk_floor", Role::inverse_low, Axis::z), self.irk_floor);
    visit(F::bits.component("irk_ceil", Role::inverse_high, Axis::z), self.irk_ceil);
    visit(flag_operand("rinf", Role::endless), self.rinf);
    visit(F::bits.plane("ixmin", Role::plane_low, Axis::x), self.ixmin);
    visit(F::bits.plane("ixmax", Role::plane_high, Axis::x), self.ixmax);
    visit(F::bits.plane("iymin", Role::plane_low, Axis::y), self.iymin);
    visit(F::bits.plane("iymax", Role::plane_high, Axis::y), self.iymax);
    visit(F::bits.plane("izmin", Role::plane_low, Axis::z), self.izmin);
    visit(F::bits.plane("izmax", Role::plane_high, Axis::z), self.izmax);
  }
};

}  // namespace hitpipe::hls
