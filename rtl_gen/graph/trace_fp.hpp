// Floats in the trace domain: an operator is recorded as one component (a call), with the operator's
// bit-level logic traced inside it. These overloads are preferred to hls/num/fp.hpp's, since they are not
// templates.
#pragma once

#include "hls/box/fp_format.hpp"
#include "hls/num/fp.hpp"
#include "rtl_gen/graph/trace.hpp"

namespace hitpipe::rtl {

using FpSignal = hls::Fp<Trace, hls::FpBits>;

FpSignal fp_sub(const FpSignal& a, const FpSignal& b);
FpSignal fp_mul(const FpSignal& a, const FpSignal& b);
hls::Order<Trace::bit> fp_compare(const FpSignal& a, const FpSignal& b);

inline FpSignal as(const char* name, const FpSignal& x, const char* file = __builtin_FILE(),
                   unsigned line = __builtin_LINE()) {
  return {as(name, x.bits, file, line), x.format};
}
inline FpSignal as(const char* name, char axis, const FpSignal& x, const char* file = __builtin_FILE(),
                   unsigned line = __builtin_LINE()) {
  return {as(name, axis, x.bits, file, line), x.format};
}

}  // namespace hitpipe::rtl
