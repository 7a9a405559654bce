// What the integer slabs unit receives: figure 7.1's input latches, prepared as section 6.2.1 says.
//   F  an IntFormat<n, t>;  D  a value domain
#pragma once

namespace hitpipe::hls {

/// Calls visit(name, field) for every port, in the order of figure 7.1. `Self` may be const.
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
    visit("irx", self.irx);
    visit("iry", self.iry);
    visit("irz", self.irz);
    visit("irlen", self.irlen);
    visit("iri_floor", self.iri_floor);
    visit("iri_ceil", self.iri_ceil);
    visit("irj_floor", self.irj_floor);
    visit("irj_ceil", self.irj_ceil);
    visit("irk_floor", self.irk_floor);
    visit("irk_ceil", self.irk_ceil);
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
