// Top function of the float slabs unit for high-level synthesis; arguments in the order of figure 7.1, as
// hls/box/fp_slabs_operands.hpp describes them.
#pragma once

#include "hls/top/top_domain.hpp"

void hitpipe_fp_slabs(hitpipe::hls::top::Real rx, hitpipe::hls::top::Real ry, hitpipe::hls::top::Real rz,
                      hitpipe::hls::top::Real rlen, hitpipe::hls::top::Real ri_inv,
                      hitpipe::hls::top::Real rj_inv, hitpipe::hls::top::Real rk_inv,
                      hitpipe::hls::top::Bit rinf, hitpipe::hls::top::Real xmin, hitpipe::hls::top::Real xmax,
                      hitpipe::hls::top::Real ymin, hitpipe::hls::top::Real ymax,
                      hitpipe::hls::top::Real zmin, hitpipe::hls::top::Real zmax,
                      hitpipe::hls::top::Bit& hit);
