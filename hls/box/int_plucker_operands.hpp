// What the integer Pluecker unit receives: figure 7.1's input latches, prepared as section 6.3.1 says.
//   F  an IntFormat<n, t>;  D  a value domain
#pragma once

namespace hitpipe::hls {

/// for_each calls visit(name, field) for every port, in the order of figure 7.1. `Self` may be const.
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
    visit("irx", self.irx);
    visit("iry", self.iry);
    visit("irz", self.irz);
    visit("irex", self.irex);
    visit("irey", self.irey);
    visit("irez", self.irez);
    visit("iri", self.iri);
    visit("irj", self.irj);
    visit("irk", self.irk);
    visit("rinf", self.rinf);
    visit("ixmin", self.ixmin);
    visit("ixmax", self.ixmax);
    visit("iymin", self.iymin);
    visit("iymax", self.iymax);
    visit("izmin", self.izmin);
    visit("izmax", self.izmax);
  }
};

}  // namespace hitpipe::hls
