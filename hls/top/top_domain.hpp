// The value domain and the format of the top functions. Domain: a vendor's ap_int.h where HITPIPE_VENDOR is
// defined or a synthesiser runs (__SYNTHESIS__), else hitpipe's own integers. Format: HITPIPE_COORD_BITS and
// HITPIPE_INTERVAL_BITS, n/t bits of the integer designs, 24/24 unless defined; float designs are binary32.
#pragma once

#include "hls/box/fp_format.hpp"
#include "hls/box/int_format.hpp"

#if defined(HITPIPE_VENDOR) || defined(__SYNTHESIS__)
#include "hls/num/vendor.hpp"
#else
#include "hls/num/domain.hpp"
#endif

#ifndef HITPIPE_COORD_BITS
#define HITPIPE_COORD_BITS 24
#endif
#ifndef HITPIPE_INTERVAL_BITS
#define HITPIPE_INTERVAL_BITS 24
#endif

namespace hitpipe::hls::top {

#if defined(HITPIPE_VENDOR) || defined(__SYNTHESIS__)
using Domain = Vendor;
#else
using Domain = Native;
#endif
using Integers = IntFormat<HITPIPE_COORD_BITS, HITPIPE_INTERVAL_BITS>;

using Bit = Domain::bit;
using Coord = Integers::Coord<Domain>;
using Interval = Integers::Interval<Domain>;
using Real = Fp32::Pattern<Domain>;

}  // namespace hitpipe::hls::top
