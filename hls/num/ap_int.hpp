// ap_int<W> and ap_uint<W>: bit-accurate integers with the names, widths and meanings of the vendors' ap_int.
// They are constexpr, trivially copyable and have no undefined behaviour. Up to 64 bits they cost what a
// machine word costs. Left out: floats and strings as sources, implicit conversion to C++ integers, rotates,
// ++ and --, shifts by a signed ap value, compound assignment to a part, reversed ranges. Text is in
// hls/num/ap_string.hpp.
#pragma once

#include "hls/num/ap_base.hpp"
#include "hls/num/ap_operators.hpp"
#include "hls/num/ap_refs.hpp"
