// What the float Pluecker unit receives: figure 7.1's input latches.
//   F  an FpFormat<E, M>;  D  a value domain
#pragma once

#include "hls/box/operand.hpp"
#include "hls/num/fp.hpp"

namespace hitpipe::hls {

/// for_each calls visit(Operand, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct FpPluckerOperands {
  using real = Fp<D, F::exponent, F::mantissa>;
  using bit = typename D::bit;

  real rx, ry, rz;     ///< ray origin
  real rex, rey, rez;  ///< ray endpoint
  real ri, rj, rk;     ///< ray direction; the sign bits choose one of the eight ray classes
  bit rinf;            ///< 1: the ray has no end, the endpoint is ignored
  real xmin, xmax;     ///< box
  real ymin, ymax;
  real zmin, zmax;

  template <class Self, class Visit>
  static constexpr void for_each(Self& self, Visit&& visit) {
    visit(F::number("rx", Role::origin, Axis::x), self.rx.bits);
    visit(F::number("ry", Role::origin, Axis::y), self.ry.bits);
    visit(F::number("rz", Role::origin, Axis::z), self.rz.bits);
    visit(F::number("rex", Role::endpoint, Axis::x), self.rex.bits);
    visit(F::number("rey", Role::endpoint, Axis::y), self.rey.bits);
    visit(F::number("rez", Role::endpoint, Axis::z), self.rez.bits);
    visit(F::number("ri", Role::direction, Axis::x), self.ri.bits);
    visit(F::number("rj", Role::direction, Axis::y), self.rj.bits);
    visit(F::number("rk", Role::direction, Axis::z), self.rk.bits);
    visit(flag_operand("rinf", Role::endless), self.rinf);
    visit(F::number("xmin", Role::plane_low, Axis::x), self.xmin.bits);
    visit(F::number("xmax", Role::plane_high, Axis::x), self.xmax.bits);
    visit(F::number("ymin", Role::plane_low, Axis::y), self.ymin.bits);
    visit(F::number("ymax", Role::plane_high, Axis::y), self.ymax.bits);
    visit(F::number("zmin", Role::plane_low, Axis::z), self.zmin.bits);
    visit(F::number("zmax", Role::plane_high, Axis::z), self.zmax.bits);
  }
};

}  // namespace hitpipe::hls
