// Floats in the trace domain: an operator is recorded as one component (a call), with the operator's
// bit-level logic traced inside it. These overloads are preferred to hls/num/fp.hpp's, since they are for
// one domain.
#pragma once

#include "hls/box/fp_format.hpp"
#include "hls/num/fp.hpp"
#include "rtl_gen/graph/trace.hpp"

namespace hitpipe::rtl {

using FpSignal = hls::Fp<Trace, hls::FpBits>;

/// The operators as components: patterns in, a pattern out. Those in _rz round toward zero.
Trace::uint call_subtract(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b);
Trace::uint call_multiply(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b);
Trace::uint call_compare(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b);
Trace::uint call_subtract_rz(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b);
Trace::uint call_multiply_rz(const hls::FpBits& format, const Trace::uint& a, const Trace::uint& b);

template <class Bits>
hls::Fp<Trace, Bits> fp_sub(const hls::Fp<Trace, Bits>& a, const hls::Fp<Trace, Bits>& b) {
  return {call_subtract(a.format, a.bits, b.bits), a.format};
}
template <class Bits>
hls::Fp<Trace, Bits> fp_mul(const hls::Fp<Trace, Bits>& a, const hls::Fp<Trace, Bits>& b) {
  return {call_multiply(a.format, a.bits, b.bits), a.format};
}
template <class Bits>
hls::Order<Trace::bit> fp_compare(const hls::Fp<Trace, Bits>& a, const hls::Fp<Trace, Bits>& b) {
  const Trace::uint order = call_compare(a.format, a.bits, b.bits);
  return {slice(order, 0, 0), slice(order, 1, 1)};
}
template <class Bits>
hls::Fp<Trace, Bits> fp_sub_rz(const hls::Fp<Trace, Bits>& a, const hls::Fp<Trace, Bits>& b) {
  return {call_subtract_rz(a.format, a.bits, b.bits), a.format};
}
template <class Bits>
hls::FpMagnitude<Trace, Bits> fp_mul_rz(const hls::FpMagnitude<Trace, Bits>& a,
                                        const hls::FpMagnitude<Trace, Bits>& b) {
  return {call_multiply_rz(a.format, a.bits, b.bits), a.format};
}

template <class Bits>
hls::Fp<Trace, Bits> as(const char* name, const hls::Fp<Trace, Bits>& x, const char* file = __builtin_FILE(),
                        unsigned line = __builtin_LINE()) {
  return {as(name, x.bits, file, line), x.format};
}
template <class Bits>
hls::Fp<Trace, Bits> as(const char* name, char axis, const hls::Fp<Trace, Bits>& x,
                        const char* file = __builtin_FILE(), unsigned line = __builtin_LINE()) {
  return {as(name, axis, x.bits, file, line), x.format};
}
template <class Bits>
hls::FpMagnitude<Trace, Bits> as(const char* name, char axis, const hls::FpMagnitude<Trace, Bits>& x,
                                 const char* file = __builtin_FILE(), unsigned line = __builtin_LINE()) {
  return {as(name, axis, x.bits, file, line), x.format};
}

}  // namespace hitpipe::rtl
