// The exact triangle test of the integer world (docs/integer_world.md): does a ray meet a closed triangle,
// from either side, and where? It is the test of Moeller and Trumbore (1997) in integers, where no value is
// rounded. With the corners v0, v1, v2 and the origin o,
//   E1 = v1 - v0, E2 = v2 - v0, q = v0 - o
//   P = D x E2, C = q x E1
//   det = E1 . P, u = q . P, v = D . C, num = E2 . C
// D is divided by its sign on the major axis, so there it is 2^S, and its products are shifts. The sign of
// num is turned for that. The edges that the line passes are u, v and e0 = 2^g det + u + v. docs/formal.md
// names the proofs. Widths: P and R n+S+1 bits, C 2n+g, det 2n+S+1, u, v and e0 2n+g+S+1, num 3n+g.
//
// Where one of u, v and e0 is 0, a hit is a tie. It counts if the ray, moved by eps along slot a and eps^2 along
// slot b, meets the triangle (docs/integer_world.md, Exactly once). With R = D x E1 the move by eps adds -P_a,
// R_a and R_a - P_a to u, v and e0, times eps. Where that is 0, slot b decides: R_b P_a - R_a P_b = 2^S det, so
// the other component, which is not 0 in a hit, and det tell the sign there.
#pragma once

#include "hls/box/format.hpp"
#include "hls/num/levels.hpp"
#include "hls/pipelines/ray_axes_parts.hpp"
#include "hls/world/triangle_operands.hpp"

namespace hitpipe {
namespace hls {
namespace int_triangle {

template <class X>
using Vector = RayAxes<X>;

/// a b - c d in w bits.
template <class X, class Y, class Z, class U, class W>
constexpr auto difference_of_products(const X& a, const Y& b, const Z& c, const U& d, const W& w) {
  return resize(a * b - c * d, w);
}

/// p . q in w bits.
template <class P, class Q, class W>
constexpr auto dot(const P& p, const Q& q, const W& w) {
  return resize(p.m * q.m + p.a * q.a + p.b * q.b, w);
}

/// x 2^low in w bits.
template <class D, class X, class L, class W>
constexpr auto shifted(const X& x, const L& low, const W& w) {
  return resize(as_signed(cat(x, D::lit(0, low))), w);
}

/// x is 0, or its sign is the wanted one.
template <class D, class X>
constexpr typename D::bit has_sign(const char* name, const X& x, const typename D::bit& negative) {
  using Bit = typename D::bit;
  const Bit same = ~(Bit(sign(x)) ^ negative);
  return as(name, same | Bit(~any<D>(x)));
}

/// Whether the moved ray passes inside of an edge that it meets at 0. The move along slot a adds a number that is
/// 0, or negative, to it. That must have the wanted sign; where it is 0, `other` tells.
template <class D>
constexpr typename D::bit moved_inside(const char* name, const typename D::bit& zero,
                                       const typename D::bit& negative, const typename D::bit& wanted,
                                       const typename D::bit& other) {
  using Bit = typename D::bit;
  return as(name, select(zero, other, Bit(~(negative ^ wanted))));
}

/// The two halves of a number.
template <class X>
constexpr auto high_half(const X& x) {
  return as_signed(slice(x, width_of(x) - 1_w, width_of(x) / 2_w));
}
template <class X>
constexpr auto low_half(const X& x) {
  return slice(x, width_of(x) / 2_w - 1_w, 0_w);
}

struct IntTriangle {
  static constexpr const char* name = "int_triangle";
  static constexpr const char* summary = "exact integer triangle test";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = triangle_kind;
  static constexpr const char* header = __FILE__;
  static constexpr bool wide = true;  ///< some values have more than 64 bits
  using Bits = WorldBits;
  using BuiltIn = FormatList<WorldFormat<20, 1, 20>>;
  template <class D, class F>
  using Operands = TriangleOperands<D, F>;
  template <class D, class F>
  using Results = TriangleResults<D, F>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const TriangleOperands<D, F>& in) {
    using Bit = typename D::bit;
    const auto n = format.coord;
    const auto side = [&](const char* name, char ray_axis, const auto& to, const auto& from) {
      return as(name, ray_axis, resize(to - from, n));
    };
    const auto from_origin = [&](char ray_axis, const auto& corner, const auto& origin) {
      const auto fine = change_if(0_w < format.finer, corner, [&](const auto& coarse) {
        return as_signed(cat(coarse, D::lit(0, format.finer)));
      });
      return as("q", ray_axis, resize(fine - origin, format.point()));
    };
    const auto v0 = to_ray_axes(in, in.x0, in.y0, in.z0);
    const auto v1 = to_ray_axes(in, in.x1, in.y1, in.z1);
    const auto v2 = to_ray_axes(in, in.x2, in.y2, in.z2);
    const auto sides = [&](const char* name, const auto& to) {
      return Vector<typename F::template Corner<D>>{side(name, 'm', to.m, v0.m), side(name, 'a', to.a, v0.a),
                                                    side(name, 'b', to.b, v0.b)};
    };
    const auto e1 = sides("e1", v1);
    const auto e2 = sides("e2", v2);
    const Vector<typename F::template Point<D>> q{from_origin('m', v0.m, in.origin_m),
                                                  from_origin('a', v0.a, in.origin_a),
                                                  from_origin('b', v0.b, in.origin_b)};

    // D = (2^S, slope_a, slope_b).
    const auto cross_bits = n + format.slope + 1_w;
    const auto along = [&](const auto& x) { return shifted<D>(x, format.slope, cross_bits); };
    const auto p_m = as("p_m", difference_of_products(in.slope_a, e2.b, in.slope_b, e2.a, cross_bits));
    const auto p_a = as("p_a", resize(in.slope_b * e2.m - along(e2.b), cross_bits));
    const auto p_b = as("p_b", resize(along(e2.a) - in.slope_a * e2.m, cross_bits));
    const Vector<decltype(p_m)> p{p_m, p_a, p_b};
    const auto moment = 2_w * n + format.finer;
    const auto c_m = as("c_m", difference_of_products(q.a, e1.b, q.b, e1.a, moment));
    const auto c_a = as("c_a", difference_of_products(q.b, e1.m, q.m, e1.b, moment));
    const auto c_b = as("c_b", difference_of_products(q.m, e1.a, q.a, e1.m, moment));
    const Vector<decltype(c_m)> c{c_m, c_a, c_b};

    const auto det = as("det", dot(e1, p, format.determinant()));
    const auto u = as("u", dot(q, p, format.edge()));
    const auto v =
        as("v", resize(shifted<D>(c_m, format.slope, format.edge()) + in.slope_a * c_a + in.slope_b * c_b,
                       format.edge()));
    const auto num = as("num", dot(e2, c, format.volume()));
    const auto fine_det = either(
        0_w < format.finer, det, [&](const auto& x) { return shifted<D>(x, format.finer, format.edge()); },
        [](const auto& x) { return x; });
    const auto rest = as("e0", resize(fine_det + u + v, format.edge()));

    const Bit back = as("back", Bit(sign(det)));
    const Bit front = ~back;
    const Bit inside = as("inside", has_sign<D>("passes_0", rest, back) & has_sign<D>("passes_u", u, front) &
                                        has_sign<D>("passes_v", v, front));
    const Bit ahead = has_sign<D>("ahead", num, Bit(front ^ in.back_m));
    Results<D, F> out;
    out.hit = as("meets", inside & ahead & any<D>(det));
    out.det_high = high_half(det);
    out.det_low = low_half(det);
    out.num_high = high_half(num);
    out.num_low = low_half(num);
    out.u_high = high_half(u);
    out.u_low = low_half(u);
    out.v_high = high_half(v);
    out.v_low = low_half(v);
    out.side = back;
    out.tie = change_if(0_w < format.crossings, out.hit, [&](const Bit& hit) {
      return as("tie", hit & ~(any<D>(u) & any<D>(v) & any<D>(rest)));
    });
    out.once = change_if(1_w < format.crossings, out.hit, [&](const Bit& hit) {
      const auto r_a = as("r_a", resize(in.slope_b * e1.m - along(e1.b), cross_bits));
      const Bit p_0 = as("p_a_is_0", Bit(~any<D>(p_a)));
      const Bit p_negative = sign(p_a);
      const Bit r_0 = as("r_a_is_0", Bit(~any<D>(r_a)));
      const Bit r_negative = sign(r_a);
      const Bit equal = as("r_is_p", Bit(r_a == p_a));
      const Bit less = as("r_less_p", Bit(r_a < p_a));
      const Bit ok_u = moved_inside<D>("ok_u", p_0, p_negative, back, r_negative);
      const Bit ok_v = moved_inside<D>("ok_v", r_0, r_negative, front, p_negative);
      const Bit ok_0 = moved_inside<D>("ok_0", equal, less, back, Bit(~p_negative));
      return as("once", hit & (any<D>(u) | ok_u) & (any<D>(v) | ok_v) & (any<D>(rest) | ok_0));
    });
    const auto of_edges = [](const Bit& of_rest, const Bit& of_v, const Bit& of_u) {
      return cat(cat(of_rest, of_v), of_u);
    };
    const auto is_0 = [](const auto& x) { return Bit(~any<D>(x)); };
    out.zero = of_edges(is_0(rest), is_0(v), is_0(u));
    out.inner =
        of_edges(Bit(~(Bit(sign(rest)) ^ back)), Bit(~(Bit(sign(v)) ^ front)), Bit(~(Bit(sign(u)) ^ front)));
    return out;
  }
};

}  // namespace int_triangle

using int_triangle::IntTriangle;

}  // namespace hls
}  // namespace hitpipe
