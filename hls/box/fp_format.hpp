// The number format of a float ray-box unit: all numbers are floats with E exponent and M fraction bits.
#pragma once

#include <cstdint>

#include "hls/box/format.hpp"
#include "hls/box/operand.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// A float format whose widths are known at run time; the default is binary32.
struct FpBits {
  int exponent = 8;   ///< E, 2..8
  int fraction = 23;  ///< M, 1..23

  static constexpr FormatField fields[] = {{"e", "E", 2, 8}, {"m", "M", 1, 23}};
  static constexpr const char* alias = "fp32";
  static constexpr const char* type = "FpFormat";
  static constexpr FpBits example() { return {8, 15}; }

  /// The type of a pattern, in a domain whose values carry their widths.
  template <class D>
  using Pattern = typename D::uint;
  /// The same without the sign.
  template <class D>
  using Magnitude = typename D::uint;

  constexpr int width() const { return 1 + exponent + fraction; }
  constexpr int bias() const { return (1 << (exponent - 1)) - 1; }
  /// Every number of binary32 is one of this format.
  constexpr bool holds_binary32() const { return exponent == 8 && fraction == 23; }
  /// The pattern of infinity, which is also the largest of a number that is not negative.
  constexpr std::int64_t infinity() const { return ((std::int64_t{1} << exponent) - 1) << fraction; }
  constexpr std::int64_t one() const { return std::int64_t{bias()} << fraction; }
  constexpr bool valid() const { return exponent >= 2 && exponent <= 8 && fraction >= 1 && fraction <= 23; }
  /// An operand of units in this format.
  constexpr Operand number(const char* name, Role role, Axis axis = Axis::none) const {
    return real_operand(name, role, axis, width());
  }
  /// An operand that is the pattern, without its sign, of a number from `low` on up to infinity.
  constexpr Operand magnitude(const char* name, Role role, Axis axis, std::int64_t low) const {
    return {name, role, axis, Kind::natural, exponent + fraction, low, infinity(), 0};
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

/// The format of a unit whose set-up makes binary32 operands only.
struct Binary32 : FpBits {
  static constexpr bool single = true;

  constexpr Binary32() = default;
  /// Tests run its datapath in smaller formats.
  constexpr Binary32(const FpBits& bits) : FpBits(bits) {}
};

}  // namespace hls
}  // namespace hitpipe
