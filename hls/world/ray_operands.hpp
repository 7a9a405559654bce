// The operands and results of the unit that makes integer rays of binary32 rays (docs/integer_world.md). M is
// the axis of the direction's largest component. Ray axes m, a and b are as in
// hls/box/int_major_operands.hpp: an axis and M trade places.
//   D  a value domain;  F  the format, a RayFormat<n, g, p, B, S, F> or RayBits
// What other units take of the results:
//   int_triangle  slope_a is s_a, or -s_a where back_a and back_m differ; so is slope_b. Its other operands
//                 are results.
//   int_major     origin_k is negated: ~origin_k + 1, or origin_k + 1 where back_k is 1. len is t_end without
//                 its g + F - B low bits. Its other operands are results.
#pragma once

#include "hls/box/operand.hpp"
#include "hls/num/fp.hpp"
#include "hls/world/ray_format.hpp"

namespace hitpipe {
namespace hls {

/// Numbers of binary32.
template <class D, class F>
struct IntRayOperands {
  using number = Fp<D, F>;

  number ox, oy, oz;
  number dx, dy, dz;
  number len;

  /// Calls visit(Operand, field) for every port. `Self` may be const.
  template <class Self, class Visit>
  static constexpr void for_each(const RayBits& /*format*/, Self& self, Visit&& visit) {
    visit(real_operand("ox", Role::origin, Axis::x, 32), self.ox);
    visit(real_operand("oy", Role::origin, Axis::y, 32), self.oy);
    visit(real_operand("oz", Role::origin, Axis::z, 32), self.oz);
    visit(real_operand("dx", Role::direction, Axis::x, 32), self.dx);
    visit(real_operand("dy", Role::direction, Axis::y, 32), self.dy);
    visit(real_operand("dz", Role::direction, Axis::z, 32), self.dz);
    visit(real_operand("len", Role::length, Axis::none, 32), self.len);
  }
};

/// If the error is 1, the other results have no meaning.
template <class D, class F>
struct IntRayResults {
  using bit = typename D::bit;
  using point = typename F::template Point<D>;
  using slope = typename F::template Slope<D>;
  using mantissa = typename F::template Mantissa<D>;
  using exponent = typename F::template Exponent<D>;

  bit error;             ///< an operand is NaN, or no ray has it (hls/pipelines/int_ray.hpp)
  bit major_y, major_z;  ///< which axis M is; x when both are 0
  bit back_m, back_a, back_b;
  point origin_m, origin_a, origin_b;
  slope s_a, s_b;  ///< magnitudes, 0..2^S
  mantissa floor_a, ceil_a;
  exponent exp_a;
  mantissa floor_b, ceil_b;
  exponent exp_b;
  typename F::template Length<D> t_end;  ///< largest T of the ray

  template <class Self, class Visit>
  static constexpr void for_each(const RayBits& format, Self& self, Visit&& visit) {
    const auto flag = [](const char* name, Meaning meaning, const char* of) {
      return Result{name, meaning, 0, 1, false, of};
    };
    const auto natural = [](const char* name, Meaning meaning, int width, const char* of) {
      return Result{name, meaning, 0, width, false, of};
    };
    const auto origin = [&](const char* name, const char* of) {
      return Result{name, Meaning::origin, 0, format.point(), true, of};
    };
    visit(flag("error", Meaning::error, "ray"), self.error);
    visit(flag("major_y", Meaning::axis, "y"), self.major_y);
    visit(flag("major_z", Meaning::axis, "z"), self.major_z);
    visit(flag("back_m", Meaning::back, "m"), self.back_m);
    visit(flag("back_a", Meaning::back, "a"), self.back_a);
    visit(flag("back_b", Meaning::back, "b"), self.back_b);
    visit(origin("origin_m", "m"), self.origin_m);
    visit(origin("origin_a", "a"), self.origin_a);
    visit(origin("origin_b", "b"), self.origin_b);
    visit(natural("s_a", Meaning::slope, format.slope + 1, "a"), self.s_a);
    visit(natural("s_b", Meaning::slope, format.slope + 1, "b"), self.s_b);
    visit(natural("floor_a", Meaning::mantissa_low, format.mantissa, "a"), self.floor_a);
    visit(natural("ceil_a", Meaning::mantissa_high, format.mantissa, "a"), self.ceil_a);
    visit(natural("exp_a", Meaning::exponent, format.exponent(), "a"), self.exp_a);
    visit(natural("floor_b", Meaning::mantissa_low, format.mantissa, "b"), self.floor_b);
    visit(natural("ceil_b", Meaning::mantissa_high, format.mantissa, "b"), self.ceil_b);
    visit(natural("exp_b", Meaning::exponent, format.exponent(), "b"), self.exp_b);
    visit(natural("t_end", Meaning::length, format.distance(), "ray"), self.t_end);
  }
};

}  // namespace hls
}  // namespace hitpipe
