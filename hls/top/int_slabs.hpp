// Top function of the integer slabs unit for high-level synthesis; arguments in the order of figure 7.1, as
// hls/box/int_slabs_operands.hpp describes them.
#pragma once

#include "hls/top/top_domain.hpp"

void hitpipe_int_slabs(hitpipe::hls::top::Coord irx, hitpipe::hls::top::Coord iry,
                       hitpipe::hls::top::Coord irz, hitpipe::hls::top::Interval irlen,
                       hitpipe::hls::top::Coord iri_floor, hitpipe::hls::top::Coord iri_ceil,
                       hitpipe::hls::top::Coord irj_floor, hitpipe::hls::top::Coord irj_ceil,
                       hitpipe::hls::top::Coord irk_floor, hitpipe::hls::top::Coord irk_ceil,
                       hitpipe::hls::top::Bit rinf, hitpipe::hls::top::Coord ixmin,
                       hitpipe::hls::top::Coord ixmax, hitpipe::hls::top::Coord iymin,
                       hitpipe::hls::top::Coord iymax, hitpipe::hls::top::Coord izmin,
                       hitpipe::hls::top::Coord izmax, hitpipe::hls::top::Bit& hit);
