// Integer slabs with a major axis for two boxes at a time: the children of one parent. The parent is the
// union of the two, so each of its six planes is a plane of a child, and the parent's interval has measured
// it already. Each face leaves one plane to measure: the plane of the child that does not reach the parent's
// face. So two boxes take four multipliers. docs/never_misses.md proves that a child is hit exactly
// when int_major hits its box.
#pragma once

#include "hls/box/format.hpp"
#include "hls/box/int_major_pair_operands.hpp"
#include "hls/pipelines/major_parts.hpp"

namespace hitpipe {
namespace hls {
namespace int_major_pair {
/// A near distance that does not bind: 0 where the plane is not the box's own.
template <class Bit, class X>
constexpr X own_near(const Bit& own, const X& t) {
  return as_signed(as_unsigned(t) & spread(own, width_of(t)));
}
/// A far distance that does not bind: the greatest number where the plane is not the box's own.
template <class Bit, class X>
constexpr X own_far(const Bit& own, const X& t) {
  const auto magnitude = width_of(t) - 1_w;
  return as_signed(cat(sign(t) & own, slice(t, magnitude - 1_w, 0_w) | spread(Bit(~own), magnitude)));
}

/// The parent's interval, cut by the planes of one box.
template <class Bit, class X>
constexpr NearFar<X> own_interval(char box, const NearFar<X>& parent, const RayAxes<NearFar<X>>& t,
                                  const RayAxes<NearFar<Bit>>& own) {
  const X near = greater<Bit>(greater<Bit>(own_near(own.m.near, t.m.near), own_near(own.a.near, t.a.near)),
                              greater<Bit>(own_near(own.b.near, t.b.near), parent.near));
  const X far = lesser<Bit>(lesser<Bit>(own_far(own.m.far, t.m.far), own_far(own.a.far, t.a.far)),
                            lesser<Bit>(own_far(own.b.far, t.b.far), parent.far));
  return {as("enters", box, near), as("leaves", box, far)};
}

struct IntMajorPair {
  static constexpr const char* name = "int_major_pair";
  static constexpr const char* summary = "as int_major, for two boxes at a time";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = pair_kind;
  static constexpr const char* header = __FILE__;
  using Bits = MajorBits;
  using BuiltIn = FormatList<MajorFormat<20, 1, 13>, MajorFormat<20, 1, 11, 0, 20>>;
  template <class D, class F>
  using Operands = IntMajorPairOperands<D, F>;
  template <class D, class F>
  using Results = IntMajorPairResults<D, F>;
  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const IntMajorPairOperands<D, F>& in) {
    using Bit = typename D::bit;
    using Distance = typename F::template Distance<D>;
    const RayAxes<Bit> low = to_ray_axes(in, in.own_xmin, in.own_ymin, in.own_zmin);
    const RayAxes<Bit> high = to_ray_axes(in, in.own_xmax, in.own_ymax, in.own_zmax);
    const auto second_owns = [](char ray_axis, const Bit& back, const Bit& lower, const Bit& upper) {
      const NearFar<Bit> own = in_ray_order(back, lower, upper);
      return NearFar<Bit>{as("second_near", ray_axis, own.near), as("second_far", ray_axis, own.far)};
    };
    const RayAxes<NearFar<Bit>> second{second_owns('m', in.back_m, low.m, high.m),
                                       second_owns('a', in.back_a, low.a, high.a),
                                       second_owns('b', in.back_b, low.b, high.b)};
    const RayAxes<NearFar<Bit>> first{
        {~second.m.near, ~second.m.far}, {~second.a.near, ~second.a.far}, {~second.b.near, ~second.b.far}};

    const auto t = plane_distances<D, F>(format, in, in);
    const NearFar<Distance> parent{resize(in.parent_near, format.distance()),
                                   resize(in.parent_far, format.distance())};
    const NearFar<Distance> box_0 = own_interval('0', parent, t, first);
    const NearFar<Distance> box_1 = own_interval('1', parent, t, second);

    Results<D, F> out;
    out.hit_0 = as("meets_0", Bit(box_0.near <= box_0.far));
    out.hit_1 = as("meets_1", Bit(box_1.near <= box_1.far));
    out.near_0 = resize(box_0.near, format.length());
    out.far_0 = resize(box_0.far, format.length());
    out.near_1 = resize(box_1.near, format.length());
    out.far_1 = resize(box_1.far, format.length());
    out.second_first = as("nearer", Bit(box_1.near < box_0.near));
    return out;
  }
};

}  // namespace int_major_pair

using int_major_pair::IntMajorPair;

}  // namespace hls
}  // namespace hitpipe
