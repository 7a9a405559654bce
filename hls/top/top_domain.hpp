// The value domain and the types of a top function: a vendor's ap_int.h where HITPIPE_VENDOR is defined or a
// synthesiser runs (__SYNTHESIS__), else hitpipe's own integers.
#pragma once

#if defined(HITPIPE_VENDOR) || defined(__SYNTHESIS__)
#include "hls/num/vendor.hpp"
#else
#include "hls/num/domain.hpp"
#endif

namespace hitpipe {
namespace hls {
namespace top {

#if defined(HITPIPE_VENDOR) || defined(__SYNTHESIS__)
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
