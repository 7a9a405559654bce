// The number format of a float ray-box unit: all its words are floats of E exponent and M fraction bits.
#pragma once

namespace hitpipe::hls {

template <int E, int M>
struct FpFormat {
  static constexpr int exponent = E;
  static constexpr int mantissa = M;
};

/// IEEE 754 binary32, the thesis's "32 bit FP".
using Fp32 = FpFormat<8, 23>;

}  // namespace hitpipe::hls
