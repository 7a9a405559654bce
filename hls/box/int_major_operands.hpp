// The operands of the major-axis unit for one box (docs/never_misses.md). M is the axis of the direction's largest
// component. The ray axes m, a and b hold what belongs to M and to the other two axes. An axis and M trade
// places: ray axis a is y, or x when M is y; ray axis b is z, or x when M is z.
//   D  a value domain;  F  the format, a MajorFormat<n, g, p, f> or MajorBits
#pragma once

#include "hls/box/major_format.hpp"

namespace hitpipe {
namespace hls {

/// What the unit knows of a ray. The unit for two boxes has the same.
template <class D, class F>
struct MajorRay {
  using point = typename F::template Point<D>;
  using mantissa = typename F::template Mantissa<D>;
  using exponent = typename F::template Exponent<D>;
  using bit = typename D::bit;

  bit major_y, major_z;                ///< which axis M is; x when both are 0
  bit back_m, back_a, back_b;          ///< 1: the direction is negative on this ray axis
  point origin_m, origin_a, origin_b;  ///< on the grid of n+g bits; x, or -x - 1 where `back` is 1
  mantissa floor_a, ceil_a;            ///< bounds of |D_M| / |D_a| 2^(p-1) / 2^exp_a
  mantissa floor_b, ceil_b;            ///< of ray axis b
  exponent exp_a, exp_b;

  /// Calls visit(Operand, field) for every port. `Self` may be const.
  template <class Self, class Visit>
  static constexpr void for_each(const MajorBits& format, Self& self, Visit&& visit) {
    visit(Operand{"major_y", Role::major, Axis::y, Kind::flag, 1, 0, 1, 0}, self.major_y);
    visit(Operand{"major_z", Role::major, Axis::z, Kind::flag, 1, 0, 1, 0}, self.major_z);
    visit(flag_operand("back_m", Role::backward), self.back_m);
    visit(flag_operand("back_a", Role::backward), self.back_a);
    visit(flag_operand("back_b", Role::backward), self.back_b);
    visit(format.origin("origin_m"), self.origin_m);
    visit(format.origin("origin_a"), self.origin_a);
    visit(format.origin("origin_b"), self.origin_b);
    visit(format.mantissa_bound("floor_a", Role::inverse_low), self.floor_a);
    visit(format.mantissa_bound("ceil_a", Role::inverse_high), self.ceil_a);
    visit(format.mantissa_bound("floor_b", Role::inverse_low), self.floor_b);
    visit(format.mantissa_bound("ceil_b", Role::inverse_high), self.ceil_b);
    visit(format.exponent_of("exp_a"), self.exp_a);
    visit(format.exponent_of("exp_b"), self.exp_b);
  }
};

/// Six planes on the grid of n bits, |value| <= 2^(n-2).
template <class D, class F>
struct MajorPlanes {
  using plane = typename F::template Plane<D>;

  plane xmin, xmax, ymin, ymax, zmin, zmax;

  template <class Self, class Visit>
  static constexpr void for_each(const MajorBits& format, Self& self, Visit&& visit) {
    visit(format.plane("xmin", Role::plane_low, Axis::x), self.xmin);
    visit(format.plane("xmax", Role::plane_high, Axis::x), self.xmax);
    visit(format.plane("ymin", Role::plane_low, Axis::y), self.ymin);
    visit(format.plane("ymax", Role::plane_high, Axis::y), self.ymax);
    visit(format.plane("zmin", Role::plane_low, Axis::z), self.zmin);
    visit(format.plane("zmax", Role::plane_high, Axis::z), self.zmax);
  }
};

/// The box is grown by half a unit of the origin's grid and then rounded outward.
template <class D, class F>
struct IntMajorOperands : MajorRay<D, F>, MajorPlanes<D, F> {
  typename F::template Length<D> len;  ///< distance to the end of the ray, at least 0

  template <class Self, class Visit>
  static constexpr void for_each(const MajorBits& format, Self& self, Visit&& visit) {
    MajorRay<D, F>::for_each(format, self, visit);
    visit(format.inner_distance("len", Role::length), self.len);
    MajorPlanes<D, F>::for_each(format, self, visit);
  }
};

}  // namespace hls
}  // namespace hitpipe
