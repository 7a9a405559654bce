// The number format of a float unit that any eEmM is for. FpBits (fp_format.hpp) is for units in binary32.
#pragma once

#include <cstdint>

#include "hls/box/fp_format.hpp"

namespace hitpipe {
namespace hls {

/// A format whose widths are known at run time; FpFormat<E, M> is its twin.
struct AnyFpBits : FpBits {
  constexpr AnyFpBits() = default;
  template <int E, int M>
  constexpr AnyFpBits(const FpFormat<E, M>& /*format*/) : FpBits(FpFormat<E, M>::bits) {}
  constexpr AnyFpBits(int e, int m) : FpBits{e, m} {}

  constexpr int bias() const { return (1 << (exponent - 1)) - 1; }
  /// Every number of binary32 is one of this format.
  constexpr bool holds_binary32() const { return exponent == 8 && fraction == 23; }
  /// The pattern of infinity, which is also the largest of a number that is not negative.
  constexpr std::int64_t infinity() const { return ((std::int64_t{1} << exponent) - 1) << fraction; }
  constexpr std::int64_t one() const { return std::int64_t{bias()} << fraction; }

  /// An operand that is the pattern, without its sign, of a number from `low` on up to infinity.
  constexpr Operand magnitude(const char* name, Role role, Axis axis, std::int64_t low) const {
    return {name, role, axis, Kind::natural, exponent + fraction, low, infinity(), 0};
  }
};

}  // namespace hls
}  // namespace hitpipe
