// What the float Pluecker unit receives: figure 7.1's input latches.
//   F  an FpFormat<E, M>;  D  a value domain
#pragma once

#include "hls/num/fp.hpp"

namespace hitpipe::hls {

/// for_each calls visit(name, field) for every port, in the order of figure 7.1. `Self` may be const.
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
    visit("rx", self.rx.bits);
    visit("ry", self.ry.bits);
    visit("rz", self.rz.bits);
    visit("rex", self.rex.bits);
    visit("rey", self.rey.bits);
    visit("rez", self.rez.bits);
    visit("ri", self.ri.bits);
    visit("rj", self.rj.bits);
    visit("rk", self.rk.bits);
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
