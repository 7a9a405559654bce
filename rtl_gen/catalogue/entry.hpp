// What a Design holds of its pipeline: a graph and a host function for a format that is chosen at run time.
#pragma once

#include <cstdint>

#include "hls/box/fp_format.hpp"
#include "hls/box/int_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/catalogue/native.hpp"
#include "rtl_gen/catalogue/traced.hpp"

namespace hitpipe::rtl {

/// A format of the program, for designs of its kind.
inline bool in_range(Format format) {
  return format.is_float() || format.bits().valid();
}

/// The widths of a format; false when pipelines of that kind do not have it.
inline bool read_format(Format format, hls::IntBits& bits) {
  if (format.is_float() || !format.bits().proved()) return false;
  bits = format.bits();
  return true;
}
inline bool read_format(Format format, hls::FpBits& bits) {
  bits = hls::Fp32::bits;
  return format.is_float();
}

template <class Pipeline>
MakeGraph traced_entry(Format format) {
  typename Pipeline::Bits bits;
  if (!read_format(format, bits)) return nullptr;
  return [bits] { return traced<Pipeline>(bits); };
}

template <class Pipeline>
Evaluate native_entry(Format format) {
  typename Pipeline::Bits bits;
  if (!read_format(format, bits)) return nullptr;
  return [bits, function = native_function<Pipeline>(bits)](const std::int64_t* operands) {
    std::int64_t hit = 0;
    function(bits, operands, &hit);
    return hit != 0;
  };
}

}  // namespace hitpipe::rtl
