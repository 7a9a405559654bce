// One test a cycle: the operands are plain ports, taken when the block starts; hit comes with a valid bit.
#include "hls/top/fp_slabs.hpp"

#include "hls/pipelines/fp_slabs.hpp"

using namespace hitpipe::hls;

void hitpipe_fp_slabs(top::Real rx, top::Real ry, top::Real rz, top::Real rlen, top::Real ri_inv,
                      top::Real rj_inv, top::Real rk_inv, top::Bit rinf, top::Real xmin, top::Real xmax,
                      top::Real ymin, top::Real ymax, top::Real zmin, top::Real zmax, top::Bit& hit) {
#ifdef __SYNTHESIS__
#pragma HLS PIPELINE II = 1
#pragma HLS INTERFACE mode = ap_none port = rx
#pragma HLS INTERFACE mode = ap_none port = ry
#pragma HLS INTERFACE mode = ap_none port = rz
#pragma HLS INTERFACE mode = ap_none port = rlen
#pragma HLS INTERFACE mode = ap_none port = ri_inv
#pragma HLS INTERFACE mode = ap_none port = rj_inv
#pragma HLS INTERFACE mode = ap_none port = rk_inv
#pragma HLS INTERFACE mode = ap_none port = rinf
#pragma HLS INTERFACE mode = ap_none port = xmin
#pragma HLS INTERFACE mode = ap_none port = xmax
#pragma HLS INTERFACE mode = ap_none port = ymin
#pragma HLS INTERFACE mode = ap_none port = ymax
#pragma HLS INTERFACE mode = ap_none port = zmin
#pragma HLS INTERFACE mode = ap_none port = zmax
#pragma HLS INTERFACE mode = ap_vld port = hit
#endif
  const FpSlabs::Operands<top::Domain, Fp32> in{{rx}, {ry},   {rz},   {rlen}, {ri_inv}, {rj_inv}, {rk_inv},
                                                rinf, {xmin}, {xmax}, {ymin}, {ymax},   {zmin},   {zmax}};
  hit = FpSlabs::test(Fp32(), in).hit;
}
