// Top function of the float Pluecker unit for high-level synthesis; arguments in the order of figure 7.1, as
// hls/box/fp_plucker_operands.hpp describes them.
#pragma once

#include "hls/top/top_domain.hpp"

void hitpipe_fp_plucker(hitpipe::hls::top::Real rx, hitpipe::hls::top::Real ry, hitpipe::hls::top::Real rz,
                        hitpipe::hls::top::Real rex, hitpipe::hls::top::Real rey, hitpipe::hls::top::Real rez,
                        hitpipe::hls::top::Real ri, hitpipe::hls::top::Real rj, hitpipe::hls::top::Real rk,
                        hitpipe::hls::top::Bit rinf, hitpipe::hls::top::Real xmin,
                        hitpipe::hls::top::Real xmax, hitpipe::hls::top::Real ymin,
                        hitpipe::hls::top::Real ymax, hitpipe::hls::top::Real zmin,
                        hitpipe::hls::top::Real zmax, hitpipe::hls::top::Bit& hit);
