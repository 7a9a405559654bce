// The operands of the integer Pluecker unit: the input latches of figure 7.1, set up by section 6.3.1.
//   D  a value domain;  F  the format, an IntFormat<n, t> or IntBits
#pragma once

#include "hls/box/int_format.hpp"

namespace hitpipe {
namespace hls {

/// for_each calls visit(Operand, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct IntPluckerOperands {
  using coord = typename F::template Coord<D>;
  using bit = typename D::bit;

  coord irx, iry, irz;     ///< ray origin on the grid, |value| <= 2^(n-2)-1
  coord irex, irey, irez;  ///< ray endpoint on the grid, rounded away from the origin, |value| <= 2^(n-2)-1
  coord iri, irj, irk;     ///< direction; the largest component is +-(2^(n-1)-1), each is rounded to nearest
  bit rinf;                ///< 1: the ray has no end in the cube, the endpoint is ignored
  coord ixmin, ixmax;      ///< box on the grid, rounded outward, |value| <= 2^(n-2)
  coord iymin, iymax;
  coord izmin, izmax;

  template <class Self, class Visit>
  static constexpr void for_each(const IntBits& format, Self& self, Visit&& visit) {
    visit(format.point("irx", Role::origin, Axis::x), self.irx);
    visit(format.point("iry", Role::origin, Axis::y), self.iry);
    visit(format.point("irz", Role::origin, Axis::z), self.irz);
    visit(format.point("irex", Role::endpoint, Axis::x), self.irex);
    visit(format.point("irey", Role::endpoint, Axis::y), self.irey);
    visit(format.point("irez", Role::endpoint, Axis::z), self.irez);
    visit(format.component("iri", Role::direction, Axis::x), self.iri);
    visit(format.component("irj", Role::direction, Axis::y), self.irj);
    visit(format.component("irk", Role::direction, Axis::z), self.irk);
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
