// One test a cycle: the operands are plain ports, taken when the block starts; hit comes with a valid bit.
#include "hls/top/int_plucker.hpp"

#include "hls/pipelines/int_plucker.hpp"

using namespace hitpipe::hls;

void hitpipe_int_plucker(top::Coord irx, top::Coord iry, top::Coord irz, top::Coord irex, top::Coord irey,
                         top::Coord irez, top::Coord iri, top::Coord irj, top::Coord irk, top::Bit rinf,
                         top::Coord ixmin, top::Coord ixmax, top::Coord iymin, top::Coord iymax,
                         top::Coord izmin, top::Coord izmax, top::Bit& hit) {
#ifdef __SYNTHESIS__
#pragma HLS PIPELINE II = 1
#pragma HLS INTERFACE mode = ap_none port = irx
#pragma HLS INTERFACE mode = ap_none port = iry
#pragma HLS INTERFACE mode = ap_none port = irz
#pragma HLS INTERFACE mode = ap_none port = irex
#pragma HLS INTERFACE mode = ap_none port = irey
#pragma HLS INTERFACE mode = ap_none port = irez
#pragma HLS INTERFACE mode = ap_none port = iri
#pragma HLS INTERFACE mode = ap_none port = irj
#pragma HLS INTERFACE mode = ap_none port = irk
#pragma HLS INTERFACE mode = ap_none port = rinf
#pragma HLS INTERFACE mode = ap_none port = ixmin
#pragma HLS INTERFACE mode = ap_none port = ixmax
#pragma HLS INTERFACE mode = ap_none port = iymin
#pragma HLS INTERFACE mode = ap_none port = iymax
#pragma HLS INTERFACE mode = ap_none port = izmin
#pragma HLS INTERFACE mode = ap_none port = izmax
#pragma HLS INTERFACE mode = ap_vld port = hit
#endif
  const IntPlucker::Operands<top::Domain, top::Integers> in{
      irx, iry, irz, irex, irey, irez, iri, irj, irk, rinf, ixmin, ixmax, iymin, iymax, izmin, izmax};
  hit = IntPlucker::test(top::Integers(), in).hit;
}
