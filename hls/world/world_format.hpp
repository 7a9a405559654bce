// The number format of the integer world (docs/integer_world.md): "n+gsS", e.g. 20+1s20, or "n+gsStF".
//   n  bits of a triangle's corner, 8..24; [-1, 1] is -G..G with G = 2^(n-2) - 1
//   g  bits by which the ray's origin is finer than the corners, 0..3
//   S  bits of a slope: the direction is (+-2^S, +-s_a, +-s_b) with 0 <= s <= 2^S along its major axis, 8..32
//   F  bits of a distance T below the unit of the origin's grid, 0..8; 0 unless it is given
#pragma once

#include <cstdint>

#include "hls/box/format.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// A format whose widths are known at run time.
struct WorldBits {
  static constexpr int min_coord = 8;
  static constexpr int max_coord = 24;
  static constexpr int max_finer = 3;
  static constexpr int min_slope = 8;
  static constexpr int max_slope = 32;
  static constexpr int max_fraction = 8;
  /// Tests use smaller formats than the program. All that is proved holds for them too.
  static constexpr int min_proved_coord = 4;
  static constexpr int min_proved_slope = 2;

  int coord = 20;    ///< n
  int finer = 1;     ///< g
  int slope = 20;    ///< S
  int fraction = 0;  ///< F

  static constexpr FormatField fields[] = {{"", "n", min_coord, max_coord},
                                           {"+", "g", 0, max_finer},
                                           {"s", "S", min_slope, max_slope},
                                           {"t", "F", 0, max_fraction, nullptr, true}};
  static constexpr const char* type = "WorldFormat";

  /// Width of the origin, and of its difference to a corner.
  constexpr int point() const { return coord + finer; }
  /// Width of a distance T, without a sign.
  constexpr int distance() const { return point() - 1 + fraction; }

  /// G.
  constexpr std::int64_t largest_corner() const { return (std::int64_t{1} << (coord - 2)) - 1; }
  /// Of an origin.
  constexpr std::int64_t largest_point() const { return largest_corner() << finer; }
  /// 2^S, the direction along the major axis.
  constexpr std::int64_t one() const { return std::int64_t{1} << slope; }
  /// No T in the cube is larger. It is the length of a ray without an end.
  constexpr std::int64_t largest_distance() const { return (std::int64_t{1} << distance()) - 1; }

  /// The program takes this format.
  constexpr bool valid() const { return proved() && coord >= min_coord && slope >= min_slope; }
  constexpr bool proved() const {
    return coord >= min_proved_coord && coord <= max_coord && finer >= 0 && finer <= max_finer &&
           slope >= min_proved_slope && slope <= max_slope && fraction >= 0 && fraction <= max_fraction;
  }
  friend constexpr bool operator==(const WorldBits& a, const WorldBits& b) {
    return a.coord == b.coord && a.finer == b.finer && a.slope == b.slope && a.fraction == b.fraction;
  }
};

}  // namespace hls
}  // namespace hitpipe
