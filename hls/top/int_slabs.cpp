// One test a cycle: the operands are plain ports, taken when the block starts; hit comes with a valid bit.
#include "hls/top/int_slabs.hpp"

#include "hls/pipelines/int_slabs.hpp"

using namespace hitpipe::hls;

void hitpipe_int_slabs(top::Coord irx, top::Coord iry, top::Coord irz, top::Interval irlen,
                       top::Coord iri_floor, top::Coord iri_ceil, top::Coord irj_floor, top::Coord irj_ceil,
                       top::Coord irk_floor, top::Coord irk_ceil, top::Bit rinf, top::Coord ixmin,
                       top::Coord ixmax, top::Coord iymin, top::Coord iymax, top::Coord izmin,
                       top::Coord izmax, top::Bit& hit) {
#ifdef __SYNTHESIS__
#pragma HLS PIPELINE II = 1
#pragma HLS INTERFACE mode = ap_none port = irx
#pragma HLS INTERFACE mode = ap_none port = iry
#pragma HLS INTERFACE mode = ap_none port = irz
#pragma HLS INTERFACE mode = ap_none port = irlen
#pragma HLS INTERFACE mode = ap_none port = iri_floor
#pragma HLS INTERFACE mode = ap_none port = iri_ceil
#pragma HLS INTERFACE mode = ap_none port = irj_floor
#pragma HLS INTERFACE mode = ap_none port = irj_ceil
#pragma HLS INTERFACE mode = ap_none port = irk_floor
#pragma HLS INTERFACE mode = ap_none port = irk_ceil
#pragma HLS INTERFACE mode = ap_none port = rinf
#pragma HLS INTERFACE mode = ap_none port = ixmin
#pragma HLS INTERFACE mode = ap_none port = ixmax
#pragma HLS INTERFACE mode = ap_none port = iymin
#pragma HLS INTERFACE mode = ap_none port = iymax
#pragma HLS INTERFACE mode = ap_none port = izmin
#pragma HLS INTERFACE mode = ap_none port = izmax
#pragma HLS INTERFACE mode = ap_vld port = hit
#endif
  const IntSlabs::Operands<top::Domain, top::Integers> in{
      irx,      iry,  irz,   irlen, iri_floor, iri_ceil, irj_floor, irj_ceil, irk_floor,
      irk_ceil, rinf, ixmin, ixmax, iymin,     iymax,    izmin,     izmax};
  hit = IntSlabs::test(top::Integers(), in).hit;
}
