// ap_int<W> and ap_uint<W>: bit-accurate integers with the names, widths and meanings of the vendors' ap_int.
// constexpr, trivially copyable, without undefined behaviour; a width up to 64 bits costs what a machine word
// costs. Left out: floats and strings as sources, implicit conversion to C++ integers, rotates, ++ and --,
// shifts by a signed ap value, compound assignment to a part, reversed ranges. Text is in
// hls/num/ap_string.hpp.
#pragma once

#include "hls/num/ap_base.hpp"
#include "hls/num/ap_operators.hpp"
#include "hls/num/ap_refs.hpp"
