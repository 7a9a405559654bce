// The format of the walker: "dDaAlLkKiI", for example d20a24l60k3i5, or "dDaAlLkKiIeEsS".
//   D  bits of a box distance, the length of int_major_pair's format
//   A  bits of a block's number in memory
//   L  levels of records that a path may have: bits of the trail
//   K  a ray's stack has 2^K places
//   I  bits of a ray's number: 2^I rays are in flight
//   E  bits of the number of triangles in a leaf; not written: those of an image
//   S  bits of the number of records that a walk may test; not written: those of the register
#pragma once

#include "hls/box/format.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// Bits of the number of triangles in a leaf, in an image; all ones is a record, 0 no child.
constexpr int child_count_bits = 8;
/// Bits of the number of records that a ray's walk may test.
constexpr int step_count_bits = 20;

struct WalkBits {
  int box = 20;                 ///< D
  int address = 24;             ///< A
  int levels = 60;              ///< L
  int stack = 3;                ///< K
  int ray = 5;                  ///< I
  int leaf = child_count_bits;  ///< E
  int steps = step_count_bits;  ///< S

  static constexpr FormatField fields[] = {{"d", "D", 4, 36},
                                           {"a", "A", 4, 32},
                                           {"l", "L", 2, 60},
                                           {"k", "K", 1, 6},
                                           {"i", "I", 1, 8},
                                           {"e", "E", 2, child_count_bits, nullptr, true},
                                           {"s", "S", 4, step_count_bits, nullptr, true}};

  constexpr int rays() const { return power_of_two(ray); }
  constexpr int places() const { return power_of_two(stack); }
  constexpr int stacks() const { return rays() * places(); }
  /// Of a level's number, and of the number of places that hold something.
  constexpr int level() const { return count_bits(levels + 1); }
  constexpr int used() const { return stack + 1; }
  friend constexpr bool operator==(const WalkBits&, const WalkBits&) = default;
};

}  // namespace hls
}  // namespace hitpipe
