// The datapaths of hls/ on a quantised ray and box, as a unit of format F<n, t> answers them.
#pragma once

#include <array>
#include <string>

#include <fmt/format.h>

#include "hls/num/domain.hpp"
#include "hls/pipelines/int_plucker.hpp"
#include "hls/pipelines/int_slabs.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rays/world/int_box.hpp"
#include "sw_ref/quantise/int_plucker_ray.hpp"
#include "sw_ref/quantise/int_slabs_ray.hpp"
#include "tests/sw_ref/judge/adversary/each_case.hpp"

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

/// An integer unit as its datapath answers, with dropped low bits.
struct NativeUnit {
  hls::IntBits bits;
  bool (*hit)(const Ray&, const IntBox&, const CoarseAxes&);
  CoarseAxes coarse{};

  /// The case, or the case moved towards the middle of the cube if it does not fit the coarser grid.
  [[nodiscard]] adversary::Case fitting(const adversary::Case& c) const {
    const IntOrigin origin = IntSlabsRaySetup(c.ray, bits).ray().origin;
    const bool fits = fits_grid(origin, quantise_box(c.box, bits.coord), coarse, bits.coord);
    return fits ? c : adversary::halved(c);
  }
  [[nodiscard]] std::string name() const {
    return fmt::format("{}/{} coarse {}", bits.coord, bits.interval, to_text(coarse));
  }
};

template <template <class> class Design, class F>
constexpr NativeUnit unit_of(const CoarseAxes& coarse = {}) {
  return {F::bits, Design<F>::hit, coarse};
}

/// From 6 to 32 bits, on fine axes and then on coarser axes.
template <template <class> class Design>
constexpr std::array native_units{unit_of<Design, hls::IntFormat<24, 24>>(),
                                  unit_of<Design, hls::IntFormat<20, 24>>(),
                                  unit_of<Design, hls::IntFormat<16, 16>>(),
                                  unit_of<Design, hls::IntFormat<12, 12>>(),
                                  unit_of<Design, hls::IntFormat<8, 8>>(),
                                  unit_of<Design, hls::IntFormat<6, 6>>(),
                                  unit_of<Design, hls::IntFormat<6, 11>>(),
                                  unit_of<Design, hls::IntFormat<31, 40>>(),
                                  unit_of<Design, hls::IntFormat<32, 6>>(),
                                  unit_of<Design, hls::IntFormat<32, 63>>(),
                                  unit_of<Design, hls::IntFormat<24, 24>>({{0, 0, 5}}),
                                  unit_of<Design, hls::IntFormat<16, 16>>({{0, 9, 2}}),
                                  unit_of<Design, hls::IntFormat<12, 12>>({{4, 0, 1}}),
                                  unit_of<Design, hls::IntFormat<6, 6>>({{0, 2, 1}}),
                                  unit_of<Design, hls::IntFormat<6, 11>>({{3, 0, 0}})};

}  // namespace hitpipe::ref
