// The operands of the float slabs unit that never misses. On an axis along which the direction is negative,
// the ray is mirrored: its direction and its origin change their sign. The unit mirrors the planes.
//   D  a value domain;  F  the format, an FpFormat<E, M> or FpBits
#pragma once

#include "hls/box/fp_format.hpp"
#include "hls/num/fp.hpp"

namespace hitpipe {
namespace hls {

/// Calls visit(Operand, field) for every port. `Self` may be const.
template <class D, class F>
struct FpSlabsSafeOperands {
  using real = Fp<D, F>;
  using magnitude = typename F::template Magnitude<D>;
  using bit = typename D::bit;

  bit back_x, back_y, back_z;  ///< 1: the direction is negative, so the axis is mirrored
  real rx, ry, rz;             ///< ray origin, mirrored, rounded down
  real rx_up, ry_up, rz_up;    ///< ray origin, mirrored, rounded up; no port if the format holds a binary32
  magnitude rlen;              ///< ray length, rounded down
  magnitude ri_low, ri_high;   ///< bounds of the scaled inverse direction of x, at least 1
  magnitude rj_low, rj_high;   ///< of y
  magnitude rk_low, rk_high;   ///< of z
  bit rinf;                    ///< 1: the ray has no end, rlen is ignored
  real xmin, xmax;             ///< box, rounded outward; a lower plane at 0 is -0, an upper one +0
  real ymin, ymax;
  real zmin, zmax;

  template <class Self, class Visit>
  static constexpr void for_each(const FpBits& format, Self& self, Visit&& visit) {
    visit(Operand{"back_x", Role::backward, Axis::x, Kind::flag, 1, 0, 1, 0}, self.back_x);
    visit(Operand{"back_y", Role::backward, Axis::y, Kind::flag, 1, 0, 1, 0}, self.back_y);
    visit(Operand{"back_z", Role::backward, Axis::z, Kind::flag, 1, 0, 1, 0}, self.back_z);
    visit(format.number("rx", Role::origin, Axis::x), self.rx);
    visit(format.number("ry", Role::origin, Axis::y), self.ry);
    visit(format.number("rz", Role::origin, Axis::z), self.rz);
    if (!format.holds_binary32()) {
      visit(format.number("rx_up", Role::origin_high, Axis::x), self.rx_up);
      visit(format.number("ry_up", Role::origin_high, Axis::y), self.ry_up);
      visit(format.number("rz_up", Role::origin_high, Axis::z), self.rz_up);
    }
    visit(format.magnitude("rlen", Role::length, Axis::none, 0), self.rlen);
    visit(format.magnitude("ri_low", Role::inverse_low, Axis::x, format.one()), self.ri_low);
    visit(format.magnitude("ri_high", Role::inverse_high, Axis::x, format.one()), self.ri_high);
    visit(format.magnitude("rj_low", Role::inverse_low, Axis::y, format.one()), self.rj_low);
    visit(format.magnitude("rj_high", Role::inverse_high, Axis::y, format.one()), self.rj_high);
    visit(format.magnitude("rk_low", Role::inverse_low, Axis::z, format.one()), self.rk_low);
    visit(format.magnitude("rk_high", Role::inverse_high, Axis::z, format.one()), self.rk_high);
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
