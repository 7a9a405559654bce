// What the float slabs unit receives: figure 7.1's input latches.
//   F  an FpFormat<E, M>;  D  a value domain
#pragma once

#include "hls/num/fp.hpp"

namespace hitpipe::hls {

/// for_each calls visit(name, field) for every port, in the order of figure 7.1. `Self` may be const.
template <class D, class F>
struct FpSlabsOperands {
  using real = Fp<D, F::exponent, F::mantissa>;
  using bit = typename D::bit;

  real rx, ry, rz;              ///< ray origin
  real rlen;                    ///< ray length, >= 0
  real ri_inv, rj_inv, rk_inv;  ///< inverse ray direction vector components (IRDVCs); 1/0 is an infinity
  bit rinf;                     ///< 1: the ray has no end, rlen is ignored
  real xmin, xmax;              ///< box
  real ymin, ymax;
  real zmin, zmax;

  template <class Self, class Visit>
  static constexpr void for_each(Self& self, Visit&& visit) {
    visit("rx", self.rx.bits);
    visit("ry", self.ry.bits);
    visit("rz", self.rz.bits);
    visit("rlen", self.rlen.bits);
    visit("ri_inv", self.ri_inv.bits);
    visit("rj_inv", self.rj_inv.bits);
    visit("rk_inv", self.rk_inv.bits);
    visit("rinf", self.rinf);
    visit("xmin", self.xmin.bits);
    visit("xmax", self.xmax.bits);
    visit("ymin", self.ymin.bits);
    visit("ymax", self.ymax.bits);
    visit("zmin", self.zmin.bits);
    visit("zmax", self.zmax.bits);
  }
};

}  // namespace hitpipe::hls
