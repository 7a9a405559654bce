// Top function of the integer Pluecker unit for high-level synthesis; arguments in the order of figure 7.1,
// as hls/box/int_plucker_operands.hpp describes them.
#pragma once

#include "hls/top/top_domain.hpp"

void hitpipe_int_plucker(hitpipe::hls::top::Coord irx, hitpipe::hls::top::Coord iry,
                         hitpipe::hls::top::Coord irz, hitpipe::hls::top::Coord irex,
                         hitpipe::hls::top::Coord irey, hitpipe::hls::top::Coord irez,
                         hitpipe::hls::top::Coord iri, hitpipe::hls::top::Coord irj,
                         hitpipe::hls::top::Coord irk, hitpipe::hls::top::Bit rinf,
                         hitpipe::hls::top::Coord ixmin, hitpipe::hls::top::Coord ixmax,
                         hitpipe::hls::top::Coord iymin, hitpipe::hls::top::Coord iymax,
                         hitpipe::hls::top::Coord izmin, hitpipe::hls::top::Coord izmax,
                         hitpipe::hls::top::Bit& hit);
