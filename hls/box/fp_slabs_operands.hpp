// The operands of the float slabs unit: the input latches of figure 7.1.
//   D  a value domain;  F  the format, an FpFormat<E, M> or FpBits
#pragma once

#include "hls/box/fp_format.hpp"
#include "hls/num/fp.hpp"

namespace hitpipe {
namespace hls {

/// for_each calls visit(Operand, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct FpSlabsOperands {
  using real = Fp<D, F>;
  using bit = typename D::bit;

  real rx, ry, rz;              ///< ray origin
  real rlen;                    ///< ray length, >= 0
  real ri_inv, rj_inv, rk_inv;  ///< inverse ray direction vector components (IRDVCs); 1/0 is an infinity
  bit rinf;                     ///< 1: the ray has no end, rlen is ignored
  real xmin, xmax;              ///< box
  real ymin, ymax;
  real zmin, zmax;

  template <class Self, class Visit>
  static constexpr void for_each(const FpBits& format, Self& self, Visit&& visit) {
    visit(format.number("rx", Role::origin, Axis::x), self.rx);
    visit(format.number("ry", Role::origin, Axis::y), self.ry);
    visit(format.number("rz", Role::origin, Axis::z), self.rz);
    visit(format.number("rlen", Role::length), self.rlen);
    visit(format.number("ri_inv", Role::inverse, Axis::x), self.ri_inv);
    visit(format.number("rj_inv", Role::inverse, Axis::y), self.rj_inv);
    visit(format.number("rk_inv", Role::inverse, Axis::z), self.rk_inv);
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
