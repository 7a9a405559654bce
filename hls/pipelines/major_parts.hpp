// What the units with a major axis have in common (docs/never_misses.md): planes brought into the ray axes m, a and
// b and mirrored, so that every direction is positive, and their distances along the ray. A distance counts
// how far the ray has moved along its major axis, in units of the planes' grid with F fraction bits.
#pragma once

#include "hls/box/int_major_operands.hpp"
#include "hls/num/bits.hpp"
#include "hls/num/levels.hpp"
#include "hls/num/saturating_shift.hpp"
#include "hls/pipelines/ray_axes_parts.hpp"

namespace hitpipe {
namespace hls {

/// Where the ray enters and where it leaves a slab.
template <class X>
struct NearFar {
  X near, far;
};

/// The values of the lower and upper plane, in the order in which the ray meets them.
template <class Bit, class X>
constexpr NearFar<X> in_ray_order(const Bit& back, const X& low, const X& high) {
  return {select(back, high, low), select(back, low, high)};
}

namespace detail {

/// A mirrored plane on the origin's grid: its g new low bits are 0, or 1 if the plane is -x - 1.
template <class Plane, class Bit, class W>
constexpr auto finer_plane(const Plane& plane, const Bit& back, const W& finer) {
  return as_signed(cat(plane, spread(back, finer)));
}

template <class X, class W>
constexpr auto without_low_bits(const X& x, const W& low) {
  return as_signed(slice(x, width_of(x) - 1_w, low));
}
template <class D, class X, class W>
constexpr auto with_low_bits(const X& x, const W& low) {
  return as_signed(cat(x, D::lit(0, low)));
}

/// x + y + 1 in w + 1 bits. A 1 below both makes the carry, so it is one adder.
template <class D, class X, class Y, class W>
constexpr auto sum_with_carry(const X& x, const Y& y, const W& w) {
  const auto one = D::lit(1, 1_w);
  const auto sum = as_signed(cat(x, one)) + as_signed(cat(y, one));
  return as_signed(slice(sum, w + 1_w, 1_w));
}

}  // namespace detail

/// The planes of a slab minus the origin on the origin's grid, all mirrored: x becomes -x - 1.
///   In the float world the two - 1 of a difference cancel, so it changes its sign exactly.
///   In the integer world the origin is negated, so a difference is a sum. The far sum has a carry: with it,
///   the difference of a plane that is not behind the origin is at least 1. Without it, a ray that lies in a
///   face and never leaves it would leave the slab where it begins.
template <class D, class F>
constexpr NearFar<typename F::template Point<D>> differences(const F& format, char ray_axis,
                                                             const typename F::template Plane<D>& low,
                                                             const typename F::template Plane<D>& high,
                                                             const typename F::template Point<D>& origin,
                                                             const typename D::bit& back) {
  const auto plane = in_ray_order(back, low, high);
  const auto on_fine_grid = [&](const auto& one) {
    const auto mirrored = as_signed(as_unsigned(one) ^ spread(back, format.coord));
    return change_if(0_w < format.finer, mirrored,
                     [&](const auto& coarse) { return detail::finer_plane(coarse, back, format.finer); });
  };
  const auto sum = [&](const auto& x) { return x + origin; };
  const auto carried_sum = [&](const auto& x) {
    return detail::sum_with_carry<D>(x, origin, format.point());
  };
  const auto from_origin = [&](const char* name, const auto& one, const auto& add) {
    return as(name, ray_axis,
              either(
                  0_w < format.slope, on_fine_grid(one),
                  [&](const auto& x) { return resize(add(x), format.point()); },
                  [&](const auto& x) { return resize(x - origin, format.point()); }));
  };
  return {from_origin("d_near", plane.near, sum), from_origin("d_far", plane.far, carried_sum)};
}

/// The distance of a plane of the major axis is the difference itself, without bits below the fraction.
template <class D, class F>
constexpr typename F::template Distance<D> major_distance(const F& format,
                                                          const typename F::template Point<D>& d) {
  const auto fewer = change_if(format.fraction < format.finer, d, [&](const auto& all) {
    return detail::without_low_bits(all, format.finer - format.fraction);
  });
  const auto more = change_if(format.finer < format.fraction, fewer, [&](const auto& all) {
    return detail::with_low_bits<D>(all, format.fraction - format.finer);
  });
  return resize(more, format.distance());
}

/// The distances of the planes of another axis: d |D_M| / |D_k|. A near distance takes the bound that
/// makes it smaller, a far distance the bound that makes it greater.
template <class D, class F>
constexpr NearFar<typename F::template Distance<D>> scaled_slab(
    const F& format, char ray_axis, const NearFar<typename F::template Point<D>>& d,
    const typename F::template Mantissa<D>& floor, const typename F::template Mantissa<D>& ceil,
    const typename F::template Exponent<D>& exponent) {
  const auto near_shifted = as("s_near", ray_axis, saturating_shift<D>(d.near, exponent));
  const auto far_shifted = as("s_far", ray_axis, saturating_shift<D>(d.far, exponent));
  const auto near_bound = as("q_near", ray_axis, select(sign(d.near), ceil, floor));
  const auto far_bound = as("q_far", ray_axis, select(sign(d.far), floor, ceil));
  const auto near_product = as("p_near", ray_axis, near_shifted * near_bound);
  const auto far_product = as("p_far", ray_axis, far_shifted * far_bound);
  const auto high = format.point() + format.mantissa - 1_w;
  return {as("t_near", ray_axis, as_signed(slice(near_product, high, format.trimmed()))),
          as("t_far", ray_axis, as_signed(slice(far_product, high, format.trimmed())))};
}

/// The distances of all six planes.
template <class D, class F>
constexpr RayAxes<NearFar<typename F::template Distance<D>>> plane_distances(
    const F& format, const MajorRay<D, F>& ray, const MajorPlanes<D, F>& planes) {
  const auto low = to_ray_axes(ray, planes.xmin, planes.ymin, planes.zmin);
  const auto high = to_ray_axes(ray, planes.xmax, planes.ymax, planes.zmax);
  const auto m = differences<D>(format, 'm', low.m, high.m, ray.origin_m, ray.back_m);
  const auto a = differences<D>(format, 'a', low.a, high.a, ray.origin_a, ray.back_a);
  const auto b = differences<D>(format, 'b', low.b, high.b, ray.origin_b, ray.back_b);
  return {
      {as("t_near_m", major_distance<D>(format, m.near)), as("t_far_m", major_distance<D>(format, m.far))},
      scaled_slab<D>(format, 'a', a, ray.floor_a, ray.ceil_a, ray.exp_a),
      scaled_slab<D>(format, 'b', b, ray.floor_b, ray.ceil_b, ray.exp_b)};
}

template <class Bit, class X>
constexpr X greater(const X& x, const X& y) {
  return select(Bit(x < y), y, x);
}
template <class Bit, class X>
constexpr X lesser(const X& x, const X& y) {
  return select(Bit(y < x), y, x);
}

}  // namespace hls
}  // namespace hitpipe
