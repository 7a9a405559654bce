// The number format of a float ray-box unit: all numbers are floats with E exponent and M fraction bits.
#pragma once

#include "hls/box/operand.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// A float format whose widths are known at run time; the default is binary32.
struct FpBits {
  int exponent = 8;   ///< E, 2..8
  int fraction = 23;  ///< M, 1..23

  /// The type of a pattern, in a domain whose values carry their widths.
  template <class D>
  using Pattern = typename D::uint;
  /// The same without the sign.
  template <class D>
  using Magnitude = typename D::uint;

  constexpr int width() const { return 1 + exponent + fraction; }
  constexpr bool valid() const { return exponent >= 2 && exponent <= 8 && fraction >= 1 && fraction <= 23; }
  /// An operand of units in this format.
  constexpr Operand number(const char* name, Role role, Axis axis = Axis::none) const {
    return real_operand(name, role, axis, width());
  }
  friend constexpr bool operator==(const FpBits& a, const FpBits& b) {
    return a.exponent == b.exponent && a.fraction == b.fraction;
  }
};

/// The same with widths known when the code is compiled.
template <int E, int M>
struct FpFormat {
  static constexpr FpBits bits{E, M};
  static_assert(bits.valid(), "a float has 2..8 exponent and 1..23 fraction bits");

  Width<E> exponent{};
  Width<M> fraction{};

  template <class D>
  using Pattern = typename D::template uint<1 + E + M>;
  template <class D>
  using Magnitude = typename D::template uint<E + M>;

  constexpr Width<1 + E + M> width() const { return {}; }
  constexpr operator FpBits() const { return bits; }
};

/// IEEE 754 binary32, the thesis's "32 bit FP".
using Fp32 = FpFormat<8, 23>;

}  // namespace hls
}  // namespace hitpipe
