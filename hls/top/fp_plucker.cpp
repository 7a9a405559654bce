// One test a cycle: the operands are plain ports, taken when the block starts; hit comes with a valid bit.
#include "hls/top/fp_plucker.hpp"

#include "hls/pipelines/fp_plucker.hpp"

using namespace hitpipe::hls;

void hitpipe_fp_plucker(top::Real rx, top::Real ry, top::Real rz, top::Real rex, top::Real rey, top::Real rez,
                        top::Real ri, top::Real rj, top::Real rk, top::Bit rinf, top::Real xmin,
                        top::Real xmax, top::Real ymin, top::Real ymax, top::Real zmin, top::Real zmax,
                        top::Bit& hit) {
#ifdef __SYNTHESIS__
#pragma HLS PIPELINE II = 1
#pragma HLS INTERFACE mode = ap_none port = rx
#pragma HLS INTERFACE mode = ap_none port = ry
#pragma HLS INTERFACE mode = ap_none port = rz
#pragma HLS INTERFACE mode = ap_none port = rex
#pragma HLS INTERFACE mode = ap_none port = rey
#pragma HLS INTERFACE mode = ap_none port = rez
#pragma HLS INTERFACE mode = ap_none port = ri
#pragma HLS INTERFACE mode = ap_none port = rj
#pragma HLS INTERFACE mode = ap_none port = rk
#pragma HLS INTERFACE mode = ap_none port = rinf
#pragma HLS INTERFACE mode = ap_none port = xmin
#pragma HLS INTERFACE mode = ap_none port = xmax
#pragma HLS INTERFACE mode = ap_none port = ymin
#pragma HLS INTERFACE mode = ap_none port = ymax
#pragma HLS INTERFACE mode = ap_none port = zmin
#pragma HLS INTERFACE mode = ap_none port = zmax
#pragma HLS INTERFACE mode = ap_vld port = hit
#endif
  const FpPlucker::Operands<top::Domain, Fp32> in{{rx}, {ry}, {rz},   {rex},  {rey},  {rez},  {ri},   {rj},
                                                  {rk}, rinf, {xmin}, {xmax}, {ymin}, {ymax}, {zmin}, {zmax}};
  hit = FpPlucker::test(Fp32(), in).hit;
}
