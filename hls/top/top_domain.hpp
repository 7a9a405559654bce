// The value domain and the types of a top function: ac_int with HITPIPE_AC_TYPES or where Bambu reads it
// (__BAMBU__), a vendor's ap_int.h with HITPIPE_VENDOR or where another synthesiser runs (__SYNTHESIS__),
// else hitpipe's own integers. hitpipe's integers need C++20, the others C++14.
#pragma once

#if defined(__BAMBU__) && !defined(HITPIPE_AC_TYPES)
#define HITPIPE_AC_TYPES
#endif

#if defined(HITPIPE_AC_TYPES)
#include "hls/num/ac_types.hpp"
#elif defined(HITPIPE_VENDOR) || defined(__SYNTHESIS__)
#include "hls/num/vendor.hpp"
#else
#include "hls/num/domain.hpp"
#endif

namespace hitpipe {
namespace hls {
namespace top {

#if defined(HITPIPE_AC_TYPES)
using Domain = AcTypes;
#elif defined(HITPIPE_VENDOR) || defined(__SYNTHESIS__)
using Domain = Vendor;
#else
using Domain = Native;
#endif

using Bit = Domain::bit;
template <int W>
using Integer = Domain::sint<W>;
/// The bits of a float, or a number without a sign.
template <int W>
using Pattern = Domain::uint<W>;

}  // namespace top
}  // namespace hls
}  // namespace hitpipe
