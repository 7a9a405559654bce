// The operands and results of the triangle unit (docs/integer_world.md). M is the axis of the direction's
// largest component. Ray axes m, a and b are as in hls/box/int_major_operands.hpp: an axis and M trade
// places.
//   D  a value domain;  F  the format, a WorldFormat<n, g, S> or WorldBits
#pragma once

#include "hls/box/operand.hpp"
#include "hls/world/world_format.hpp"

namespace hitpipe {
namespace hls {

template <class D, class F>
struct TriangleOperands {
  using point = typename F::template Point<D>;
  using slope = typename F::template Slope<D>;
  using corner = typename F::template Corner<D>;
  using bit = typename D::bit;

  bit major_y, major_z;                ///< which axis M is; x when both are 0
  bit back_m;                          ///< 1: the direction is negative on M
  point origin_m, origin_a, origin_b;  ///< on the grid of n+g bits
  slope slope_a, slope_b;              ///< the direction on ray axes a and b, divided by its sign on M
  corner x0, y0, z0, x1, y1, z1, x2, y2, z2;

  /// Calls visit(Operand, field) for every port. `Self` may be const.
  template <class Self, class Visit>
  static constexpr void for_each(const WorldBits& format, Self& self, Visit&& visit) {
    visit(Operand{"major_y", Role::major, Axis::y, Kind::flag, 1, 0, 1, 0}, self.major_y);
    visit(Operand{"major_z", Role::major, Axis::z, Kind::flag, 1, 0, 1, 0}, self.major_z);
    visit(flag_operand("back_m", Role::backward), self.back_m);
    visit(format.origin("origin_m"), self.origin_m);
    visit(format.origin("origin_a"), self.origin_a);
    visit(format.origin("origin_b"), self.origin_b);
    visit(format.slope_of("slope_a"), self.slope_a);
    visit(format.slope_of("slope_b"), self.slope_b);
    visit(format.corner("x0", Axis::x, 0), self.x0);
    visit(format.corner("y0", Axis::y, 0), self.y0);
    visit(format.corner("z0", Axis::z, 0), self.z0);
    visit(format.corner("x1", Axis::x, 1), self.x1);
    visit(format.corner("y1", Axis::y, 1), self.y1);
    visit(format.corner("z1", Axis::z, 1), self.z1);
    visit(format.corner("x2", Axis::x, 2), self.x2);
    visit(format.corner("y2", Axis::y, 2), self.y2);
    visit(format.corner("z2", Axis::z, 2), self.z2);
  }
};

/// A port has at most 64 bits, so each number is two ports: its high half with the sign, and its low half.
/// The numbers have a meaning only if HIT is 1, and then det is not 0.
///   T       = floor(2^(S+F) |num| / |det|)
///   weight of corner 1 = |u| / (2^g |det|), of corner 2 = |v| / (2^g |det|)
/// Of crossings, each one bit (docs/integer_world.md, Exactly once):
///   tie     a hit with u, v or e0 of 0; it is 0 without HIT
///   once    the hit counts; it is 0 without HIT
///   zero    of any test, bits 0, 1 and 2: u, v and e0 are 0
///   inner   likewise: they have the sign that they have inside of the triangle; of 0 it means nothing
///   side    det < 0. D . E1 x E2 is above 0 where side + back_m + major_y + major_z is odd
template <class D, class F>
struct TriangleResults {
  using bit = typename D::bit;

  bit hit;
  typename F::template DeterminantHigh<D> det_high;
  typename F::template DeterminantLow<D> det_low;
  typename F::template VolumeHigh<D> num_high;
  typename F::template VolumeLow<D> num_low;
  typename F::template EdgeHigh<D> u_high, v_high;
  typename F::template EdgeLow<D> u_low, v_low;
  bit tie, once, side;
  typename F::template EdgeFlags<D> zero, inner;

  template <class Format, class Self, class Visit>
  static constexpr void for_each(const Format& format, Self& self, Visit&& visit) {
    const WorldBits bits = format;
    const auto high = [](const char* name, Meaning meaning, int width) {
      return Result{name, meaning, 0, width - width / 2, true};
    };
    const auto low = [](const char* name, Meaning meaning, int width) {
      return Result{name, meaning, 0, width / 2, false};
    };
    visit(Result{"hit", Meaning::hit, 0, 1, false, "triangle"}, self.hit);
    visit(high("det_high", Meaning::determinant, bits.determinant()), self.det_high);
    visit(low("det_low", Meaning::determinant_low, bits.determinant()), self.det_low);
    visit(high("num_high", Meaning::volume, bits.volume()), self.num_high);
    visit(low("num_low", Meaning::volume_low, bits.volume()), self.num_low);
    if (bits.weights != 0) {
      visit(high("u_high", Meaning::edge_u, bits.edge()), self.u_high);
      visit(low("u_low", Meaning::edge_u_low, bits.edge()), self.u_low);
      visit(high("v_high", Meaning::edge_v, bits.edge()), self.v_high);
      visit(low("v_low", Meaning::edge_v_low, bits.edge()), self.v_low);
    }
    const auto flag = [](const char* name, Meaning meaning) {
      return Result{name, meaning, 0, 1, false, "triangle"};
    };
    if (bits.crossings % 2 == 1) visit(flag("tie", Meaning::tie), self.tie);
    if (bits.crossings == 2) visit(flag("once", Meaning::once), self.once);
    if (bits.crossings == 1 || bits.crossings == 2) visit(flag("side", Meaning::side), self.side);
    if (bits.crossings == 3) {
      visit(Result{"zero", Meaning::zero, 0, 3, false, "triangle"}, self.zero);
      visit(Result{"inner", Meaning::inner, 0, 3, false, "triangle"}, self.inner);
    }
  }
};

}  // namespace hls
}  // namespace hitpipe
