// The float Pluecker test of section 3.3, figures 7.7 to 7.10. The ray meets the box if it passes inside the
// six edges of the box's silhouette and the box lies between the ray's ends. Side relations are rounded, so,
// like float slabs, it can miss a box that a ray grazes.
#pragma once

#include "hls/box/box_hit.hpp"
#include "hls/box/format.hpp"
#include "hls/box/fp_plucker_operands.hpp"
#include "hls/pipelines/plucker_parts.hpp"

namespace hitpipe {
namespace hls {
namespace fp_plucker {
/// Planes less the origin: stages 1 to 7, figure 7.8.
template <class Real>
constexpr auto fp_axis_view(char axis, const Real& direction, const Real& origin, const Real& plane_min,
                            const Real& plane_max) {
  const Real a = as("a", axis, fp_sub(plane_min, origin));
  const Real b = as("b", axis, fp_sub(plane_max, origin));
  return axis_view(direction, sign(direction), a, b);
}

/// fp_compare as a function object.
struct FpOrder {
  template <class Real>
  constexpr auto operator()(const Real& a, const Real& b) const {
    return fp_compare(a, b);
  }
};

/// A term of a side relation.
template <class Real>
constexpr Real fp_side_term(const char* name, char number, const SideFactors<Real>& factors) {
  return as(name, number, fp_mul(factors.direction, factors.plane));
}

/// The side relation of ray and edge is negative: figures 7.9 and 7.10.
struct FpNegativeSide {
  template <class Real>
  constexpr typename Real::Bit operator()(char number, const SilhouetteEdge<Real>& edge) const {
    const Real q = fp_side_term("q", number, edge.q);
    const Real p = fp_side_term("p", number, edge.p);
    const Real side = as("side", number, fp_sub(q, p));
    return as("outside", number, fp_less(side, fp_zero(side)));
  }
};

/// The whole test. `outside` says whether the ray passes outside an edge.
template <class D, class F, class Outside>
constexpr typename D::bit fp_plucker_hit(const FpPluckerOperands<D, F>& in, const Outside& outside) {
  using Bit = typename D::bit;
  const FpOrder compare;
  const auto x = fp_axis_view('x', in.ri, in.rx, in.xmin, in.xmax);
  const auto y = fp_axis_view('y', in.rj, in.ry, in.ymin, in.ymax);
  const auto z = fp_axis_view('z', in.rk, in.rz, in.zmin, in.zmax);
  const Bit extent =
      within_extent(axis_extent('x', x.minus, in.rx, in.rex, in.xmin, in.xmax, compare),
                    axis_extent('y', y.minus, in.ry, in.rey, in.ymin, in.ymax, compare),
                    axis_extent('z', z.minus, in.rz, in.rez, in.zmin, in.zmax, compare), in.rinf);
  const auto xy = edge_pair(x, y, '0', '1');
  const auto zx = edge_pair(z, x, '2', '3');
  const auto yz = edge_pair(y, z, '4', '5');
  const Bit hit01 = as("hit01", ~outside('0', xy.first) & ~outside('1', xy.second));
  const Bit hit23 = as("hit23", ~outside('2', zx.first) & ~outside('3', zx.second));
  const Bit hit45 = as("hit45", ~outside('4', yz.first) & ~outside('5', yz.second));
  return as("inside", (hit01 & hit23) & (hit45 & extent));
}

struct FpPlucker {
  static constexpr const char* name = "fp_plucker";
  static constexpr const char* summary = "float Pluecker test, figures 7.7-7.10";
  static constexpr bool conservative = false;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  static constexpr bool rounds_to_nearest = true;
  using Bits = Binary32;
  using BuiltIn = FormatList<Fp32>;
  template <class D, class F>
  using Operands = FpPluckerOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& /*format*/, const FpPluckerOperands<D, F>& in) {
    return {fp_plucker_hit(in, FpNegativeSide())};
  }
};

}  // namespace fp_plucker

using fp_plucker::FpPlucker;

}  // namespace hls
}  // namespace hitpipe
