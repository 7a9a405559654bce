// What the integer Pluecker unit receives: figure 7.1's input latches, prepared as section 6.3.1 says.
//   F  an IntFormat<n, t>;  D  a value domain
#pragma once

#include "hls/box/operand.hpp"

namespace hitpipe::hls {

/// for_each calls visit(Operand, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct IntPluckerOperands {
  using coord = typename D::template sint<F::coord>;
  using bit = typename D::bit;

  coord irx, iry, irz;     ///< ray origin on the grid, |value| <= 2^(n-2)-1
  coord irex, irey, irez;  ///< ray endpoint on the grid, rounded away from the origin, |value| <= 2^(n-2)-1
  coord iri, irj, irk;     ///< direction; the largest component is +-(2^(n-1)-1), each is rounded to nearest
  bit rinf;                ///< 1: the ray has no end in the cube, the endpoint is ignored
  coord ixmin, ixmax;      ///< box on the grid, rounded outward, |value| <= 2^(n-2)
  coord iymin, iymax;
  coord izmin, izmax;

  template <class Self, class Visit>
  static constexpr void for_each(Self& self, Visit&& visit) {
    visit(F::bits.point("irx", Role::origin, Axis::x), self.irx);
    visit(F::bits.point("iry", Role::origin, Axis::y), self.iry);
    visit(F::bits.point("irz", Role::origin, Axis::z), self.irz);
    visit(F::bits.point("irex", Role::endpoint, Axis::x), self.irex);
    visit(F::bits.point("irey", Role::endpoint, Axis::y), self.irey);
    visit(F::bits.point("irez", Role::endpoint, Axis::z), self.irez);
    visit(F::bits.component("iri", Role::direction, Axis::x), self.iri);
    visit(F::bits.component("irj", Role::direction, Axis::y), self.irj);
    visit(F::bits.component("irk", Role::direction, Axis::z), self.irk);
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
