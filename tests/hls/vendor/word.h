// W bits in a wide machine word: what the stand-ins for vendors' integers share. C++14.
#pragma once

#include <cstdint>

namespace word {

__extension__ typedef __int128 wide;
__extension__ typedef unsigned __int128 pattern;

constexpr int max(int a, int b) { return a < b ? b : a; }

/// The number whose low W bits are given, read with a sign (S) or without one.
template <int W, bool S>
wide number(pattern bits) {
  static_assert(W >= 1 && W <= 127, "the stand-ins have 1 to 127 bits");
  const pattern low = bits & ((pattern(1) << W) - 1);
  const bool negative = S && (low >> (W - 1)) != 0;
  return static_cast<wide>(low) - (negative ? static_cast<wide>(pattern(1) << W) : 0);
}

/// The width in which an operand of W1 bits is exact beside one that is signed or not.
template <int W1, bool S1, bool S2>
struct Beside {
  static const int width = W1 + (S2 && !S1 ? 1 : 0);
};

}  // namespace word
