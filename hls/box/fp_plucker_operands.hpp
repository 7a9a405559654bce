// The operands of the float Pluecker unit: the input latches of figure 7.1.
//   D  a value domain;  F  the format, an FpFormat<E, M> or FpBits
#pragma once

#include "hls/box/fp_format.hpp"
#include "hls/num/fp.hpp"

namespace hitpipe {
namespace hls {

/// for_each calls visit(Operand, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct FpPluckerOperands {
  using real = Fp<D, F>;
  using bit = typename D::bit;

  real rx, ry, rz;     ///< ray origin
  real rex, rey, rez;  ///< ray endpoint
  real ri, rj, rk;     ///< ray direction; the sign bits choose one of the eight ray classes
  bit rinf;            ///< 1: the ray has no end, the endpoint is ignored
  real xmin, xmax;     ///< box
  real ymin, ymax;
  real zmin, zmax;

  template <class Self, class Visit>
  static constexpr void for_each(const FpBits& format, Self& self, Visit&& visit) {
    visit(format.number("rx", Role::origin, Axis::x), self.rx);
    visit(format.number("ry", Role::origin, Axis::y), self.ry);
    visit(format.number("rz", Role::origin, Axis::z), self.rz);
    visit(format.number("rex", Role::endpoint, Axis::x), self.rex);
    visit(format.number("rey", Role::endpoint, Axis::y), self.rey);
    visit(format.number("rez", Role::endpoint, Axis::z), self.rez);
    visit(format.number("ri", Role::direction, Axis::x), self.ri);
    visit(format.number("rj", Role::direction, Axis::y), self.rj);
    visit(format.number("rk", Role::direction, Axis::z), self.rk);
    visit(flag_operand("rinf", Role::endless), self.rinf);
    visit(format.number("xmin", Role::plane_low, Axis::x), self.xmin);
    visit(format.number("xmax", Role::plane_high, Axis::x), self.xmax);
    visit(format.number("ymin", Role::plane_low, Axis::y), self.ymin);
    visit(format.number("ymax", Role::plane_high, Axis::y), self.ymax);
    visit(format.number("zmin", Role::plane_low, Axis::z), self.zmin);
    visit(format.number("zmax", Role::plane_high, Axis::z), self.zmax);
  }
};

}  // namespace hls
}  // namespace hitpipe
