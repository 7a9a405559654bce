// A float slabs test, in eEmM, that never misses: does a ray meet a closed box? All rounding is
// toward zero, which takes the fewest gates. A near distance may be too small. A far difference is too small
// as well, so the set-up makes its factor larger by one part in 2^M. Near and far products are cut in the
// same way, which keeps their order. docs/never_misses.md proves that the unit never
// misses. There are no NaN: an infinite inverse makes a far distance infinite, and a near distance infinite
// or 0.
#pragma once

#include "hls/box/box_hit.hpp"
#include "hls/box/format.hpp"
#include "hls/box/fp_slabs_safe_operands.hpp"

namespace hitpipe {
namespace hls {
namespace fp_slabs_safe {
/// Distances at which a ray enters and leaves a slab, as patterns without sign. Patterns have the order of
/// the numbers.
template <class Magnitude, class Bit>
struct SafeSlab {
  Magnitude near, far;
  Bit behind;  ///< 1: the ray starts beyond the slab, and `far` means nothing
};

/// What the unit knows of a ray along one axis.
template <class D, class F>
struct SafeSlabRay {
  typename D::bit back;
  Fp<D, F> origin_low, origin_high;
  FpMagnitude<D, F> inverse_low, inverse_high;
};

template <class D, class F>
constexpr SafeSlab<typename F::template Magnitude<D>, typename D::bit> safe_slab(char axis,
                                                                                 const SafeSlabRay<D, F>& ray,
                                                                                 const Fp<D, F>& plane_min,
                                                                                 const Fp<D, F>& plane_max) {
  using Bit = typename D::bit;
  const F& format = ray.origin_low.format;
  const auto near_plane = as("near_plane", axis, select(ray.back, negated(plane_max), plane_min));
  const auto far_plane = as("far_plane", axis, select(ray.back, negated(plane_min), plane_max));
  // A difference of zero is not negative. So a ray that starts in the far plane does not count as behind
  // it.
  const auto d_near = as("d_near", axis, fp_sub_rz(near_plane, ray.origin_high));
  const auto d_far = as("d_far", axis, fp_sub_rz(far_plane, ray.origin_low));
  // A product reads a subnormal number as a larger number. A near distance must not be larger, so it is 0.
  const Bit normal = any<D>(slice(d_near.bits, format.exponent + format.fraction - 1_w, format.fraction));
  const Bit ahead = as("ahead", axis, Bit(~sign(d_near) & normal));
  const auto to_near = as("t_near", axis, fp_mul_rz(magnitude(d_near), ray.inverse_low));
  const auto to_far = as("t_far", axis, fp_mul_rz(magnitude(d_far), ray.inverse_high));
  return {to_near.bits & spread(ahead, format.exponent + format.fraction), to_far.bits, sign(d_far)};
}

struct FpSlabsSafe {
  static constexpr const char* name = "fp_slabs_safe";
  static constexpr const char* summary = "float slabs test that never misses";
  static constexpr bool conservative = true;
  static constexpr DesignKind kind = box_kind;
  static constexpr const char* header = __FILE__;
  using Bits = FpBits;
  using BuiltIn = FormatList<FpFormat<8, 23>, FpFormat<8, 15>, FpFormat<8, 7>, FpFormat<5, 10>>;
  template <class D, class F>
  using Operands = FpSlabsSafeOperands<D, F>;
  template <class D, class F>
  using Results = BoxHit<typename D::bit>;
  template <class D, class F>
  static constexpr Results<D, F> test(const F& format, const FpSlabsSafeOperands<D, F>& in) {
    using Bit = typename D::bit;
    const bool one_origin = FpBits(format).holds_binary32();
    const auto x = safe_slab(
        'x',
        SafeSlabRay<D, F>{
            in.back_x, in.rx, one_origin ? in.rx : in.rx_up, {in.ri_low, format}, {in.ri_high, format}},
        in.xmin, in.xmax);
    const auto y = safe_slab(
        'y',
        SafeSlabRay<D, F>{
            in.back_y, in.ry, one_origin ? in.ry : in.ry_up, {in.rj_low, format}, {in.rj_high, format}},
        in.ymin, in.ymax);
    const auto z = safe_slab(
        'z',
        SafeSlabRay<D, F>{
            in.back_z, in.rz, one_origin ? in.rz : in.rz_up, {in.rk_low, format}, {in.rk_high, format}},
        in.zmin, in.zmax);
    const auto near_xy = as("t_near_xy", select(Bit(x.near < y.near), y.near, x.near));
    const auto near = as("t_near", select(Bit(near_xy < z.near), z.near, near_xy));
    const auto far_xy = as("t_far_xy", select(Bit(y.far < x.far), y.far, x.far));
    const auto far = as("t_far", select(Bit(z.far < far_xy), z.far, far_xy));

    const Bit behind = as("behind", Bit(x.behind | y.behind | z.behind));
    const Bit apart = as("apart", Bit(far < near));
    const Bit beyond = as("beyond", Bit(in.rlen < near));
    return {as("overlap", (~behind & ~apart) & (~beyond | in.rinf))};
  }
};

}  // namespace fp_slabs_safe

using fp_slabs_safe::FpSlabsSafe;

}  // namespace hls
}  // namespace hitpipe
