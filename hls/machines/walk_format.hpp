// The format of the walker: "dDaAlLkKiI", for example d20a24l60k3i5.
//   D  bits of a box distance, the length of int_major_pair's format
//   A  bits of a block's number in memory
//   L  levels of records that a path may have: bits of the trail
//   K  a ray's stack has 2^K places
//   I  bits of a ray's number: 2^I rays are in flight
#pragma once

#include "hls/box/format.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// A format whose widths are known at run time.
struct WalkBits {
  int distance = 20;  ///< D
  int address = 24;   ///< A
  int levels = 60;    ///< L
  int stack = 3;      ///< K
  int ray = 5;        ///< I

  static constexpr FormatField fields[] = {
      {"d", "D", 4, 36}, {"a", "A", 4, 32}, {"l", "L", 2, 60}, {"k", "K", 1, 6}, {"i", "I", 1, 8}};
  static constexpr const char* type = "WalkFormat";

  constexpr int rays() const { return power_of_two(ray); }
  constexpr int places() const { return power_of_two(stack); }
  friend constexpr bool operator==(const WalkBits& a, const WalkBits& b) {
    return a.distance == b.distance && a.address == b.address && a.levels == b.levels && a.stack == b.stack &&
           a.ray == b.ray;
  }
};

/// The same with widths known when the code is compiled: WalkFormat<20, 24, 60, 3, 5> is d20a24l60k3i5.
template <int Distance, int Address, int Levels, int Stack, int Ray>
struct WalkFormat {
  static constexpr WalkBits bits{Distance, Address, Levels, Stack, Ray};

  Width<Distance> distance{};
  Width<Address> address{};
  Width<Levels> levels{};
  Width<Stack> stack{};
  Width<Ray> ray{};

  constexpr operator WalkBits() const { return bits; }
};

/// Bits of the number of triangles in a leaf; all ones is a record, 0 no child.
constexpr int child_count_bits = 8;
/// Bits of the number of records that a ray's walk may test.
constexpr int step_count_bits = 20;

}  // namespace hls
}  // namespace hitpipe
