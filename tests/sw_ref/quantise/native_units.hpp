// The datapaths of hls/ on a quantised ray and box, as a unit of format F<n, t> answers them.
#pragma once

#include "hls/num/domain.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"

namespace hitpipe::ref {

template <class Operands>
void set_box(Operands& in, const IntBox& box) {
  in.ixmin = box.min[0];
  in.ixmax = box.max[0];
  in.iymin = box.min[1];
  in.iymax = box.max[1];
  in.izmin = box.min[2];
  in.izmax = box.max[2];
}

template <class F>
struct NativeSlabs {
  [[nodiscard]] static bool hit(const Ray& exact, const IntBox& box, const CoarseAxes& coarse) {
    const IntSlabsRay ray = IntSlabsRaySetup(exact, F::bits).ray();
    const IntOrigin origin = coarse_origin(ray.origin, coarse, F::bits.coord);
    hls::IntSlabsOperands<hls::Native, F> in;
    in.irx = origin[0];
    in.iry = origin[1];
    in.irz = origin[2];
    in.irlen = ray.length;
    in.iri_floor = ray.irdvc_floor[0];
    in.iri_ceil = ray.irdvc_ceil[0];
    in.irj_floor = ray.irdvc_floor[1];
    in.irj_ceil = ray.irdvc_ceil[1];
    in.irk_floor = ray.irdvc_floor[2];
    in.irk_ceil = ray.irdvc_ceil[2];
    in.rinf = ray.infinite;
    set_box(in, box);
    return hls::IntSlabs::test(F(), in).hit.to_bool();
  }
};

template <class F>
struct NativePlucker {
  [[nodiscard]] static bool hit(const Ray& exact, const IntBox& box, const CoarseAxes& coarse) {
    const IntPluckerRay ray = IntPluckerRaySetup(exact, F::bits).ray();
    const IntOrigin origin = coarse_origin(ray.origin, coarse, F::bits.coord);
    hls::IntPluckerOperands<hls::Native, F> in;
    in.irx = origin[0];
    in.iry = origin[1];
    in.irz = origin[2];
    in.irex = ray.end.at[0];
    in.irey = ray.end.at[1];
    in.irez = ray.end.at[2];
    in.iri = ray.direction[0];
    in.irj = ray.direction[1];
    in.irk = ray.direction[2];
    in.rinf = ray.end.infinite;
    set_box(in, box);
    return hls::IntPlucker::test(F(), in).hit.to_bool();
  }
};

}  // namespace hitpipe::ref
