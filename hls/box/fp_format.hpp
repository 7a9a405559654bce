// The number format of a float ray-box unit: all its words are floats of E exponent and M fraction bits.
#pragma once

#include "hls/box/operand.hpp"

namespace hitpipe::hls {

/// A float format whose widths are known at run time; binary32 unless said otherwise.
struct FpBits {
  int exponent = 8;
  int fraction = 23;
  friend constexpr bool operator==(const FpBits&, const FpBits&) = default;
};

template <int E, int M>
struct FpFormat {
  static constexpr int exponent = E;
  static constexpr int mantissa = M;
  static constexpr int width = 1 + E + M;

  /// An operand of units in this format.
  static constexpr Operand number(const char* name, Role role, Axis axis = Axis::none) {
    return real_operand(name, role, axis, width);
  }
};

/// IEEE 754 binary32, the thesis's "32 bit FP".
using Fp32 = FpFormat<8, 23>;

}  // namespace hitpipe::hls
