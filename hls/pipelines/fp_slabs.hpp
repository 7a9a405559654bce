// The float slabs test of section 2.3.1, figures 7.2 and 7.3: does a ray meet a box, in floating point?
// Rounding makes it miss boxes that a ray only grazes. It is the thesis's baseline and guarantees nothing.
// A distance can be NaN: 0 times an infinite IRDVC, when the origin lies in a face that is parallel to the
// ray. NaN compares false.
#pragma once

#include "hls/box/box_hit.hpp"
#include "hls/box/format.hpp"
#include "hls/box/fp_slabs_operands.hpp"

namespace hitpipe {
namespace hls {
namespace fp_slabs {
/// Distances at which a ray enters and leaves a slab.
template <class Real>
struct FpSlabInterval {
  Real near, far;
};

/// Stages 1 to 12, figure 7.2, and the sorting by the IRDVC's sign that opens stage 13.
template <class Real>
constexpr FpSlabInterval<Real> fp_slab_interval(char axis, const Real& origin, const Real& plane_min,
                                                const Real& plane_max, const Real& inverse) {
  const Real d0 = as("d0", axis, fp_sub(plane_min, origin));
  const Real d1 = as("d1", axis, fp_sub(plane_max, origin));
  const Real t0 = as("t0", axis, fp_mul(d0, inverse));
  const Real t1 = as("t1", axis, fp_mul(d1, inverse));
  const auto backward = sign(inverse);
  const Real near = as("t_near", axis, select(backward, t1, t0));
  return {near, as("t_far", axis, select(backward, t0, t1))};
}

/// Stage 13, figure 7.3: the three intervals and the ray's own [0, rlen] have a point in common.
template <class Bit, class Real>
constexpr Bit fp_slabs_overlap(const FpSlabInterval<Real>& x, const FpSlabInterval<Real>& y,
                               const FpSlabInterval<Real>& z, const Real& rlen, const Bit& rinf) {
  const Real near_xy = as("t_near_xy", select(fp_less(x.near, y.near), y.near, x.near));
  const Real near = as("t_near", select(fp_less(near_xy, z.near), z.near, near_xy));
  const Real far_xy = as("t_far_xy", select(fp_less(y.far, x.far), y.far, x.far));
  const Real far = as("t_far", select(fp_less(z.far, far_xy), z.far, far_xy));

  const Bit behind = sign(far);
  const Bit apart = as("apart", fp_less(far, near));
  const Bit beyond = as("beyond", fp_less(rlen, near));
  return as("overlap", (~behind & ~apart) & (~beyond | rinf));
}

struct FpSlabs {
  static constexpr const char* name = "fp_slabs";
  static constexpr const char* summary = "float slabs test, figures 7.2-7.3";
  static constexpr bool conservative = false;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  static constexpr bool rounds_to_nearest = true;
  using Bits = Binary32;
  using BuiltIn = FormatList<Fp32>;
  template <class D, class F>
  using Operands = FpSlabsOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;

  template <class D, class F>
  static constexpr Results<D, F> test(const F& /*format*/, const FpSlabsOperands<D, F>& in) {
    const auto x = fp_slab_interval('x', in.rx, in.xmin, in.xmax, in.ri_inv);
    const auto y = fp_slab_interval('y', in.ry, in.ymin, in.ymax, in.rj_inv);
    const auto z = fp_slab_interval('z', in.rz, in.zmin, in.zmax, in.rk_inv);
    return {fp_slabs_overlap(x, y, z, in.rlen, in.rinf)};
  }
};

}  // namespace fp_slabs

using fp_slabs::FpSlabs;

}  // namespace hls
}  // namespace hitpipe
