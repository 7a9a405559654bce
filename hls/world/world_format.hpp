// The number format of the integer world (docs/integer_world.md): "n+gsS", e.g. 20+1s20, or "n+gsStFbBcC".
//   n  bits of a triangle's corner, 8..24; [-1, 1] is -G..G with G = 2^(n-2) - 1
//   g  bits by which the ray's origin is finer than the corners, 0..3
//   S  bits of a slope: the direction is (+-2^S, +-s_a, +-s_b) with 0 <= s <= 2^S along its major axis, 8..32
//   F  bits of a distance T below the unit of the origin's grid, 0..8; 0 unless it is given
//   B  1: a triangle unit gives the numbers from which the weights of the corners are made; 0 unless it is
//   given
//   C  what a triangle unit says of crossings, 0 unless it is given. 1: which hits are ties; 2: which hits count; both
// give
//   the side too. 3: which hits are ties, and of any test which of u, v and e0 are 0, and which are inside
#pragma once

#include <cstdint>

#include "hls/box/format.hpp"
#include "hls/box/operand.hpp"
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
  static constexpr int max_crossings = 3;
  /// Tests use smaller formats than the program. All that is proved holds for them too.
  static constexpr int min_proved_coord = 4;
  static constexpr int min_proved_slope = 2;

  int coord = 20;     ///< n
  int finer = 1;      ///< g
  int slope = 20;     ///< S
  int fraction = 0;   ///< F
  int weights = 0;    ///< B
  int crossings = 0;  ///< C

  static constexpr FormatField fields[] = {
      {"", "n", min_coord, max_coord},  {"+", "g", 0, max_finer},
      {"s", "S", min_slope, max_slope}, {"t", "F", 1, max_fraction, nullptr, true},
      {"b", "B", 1, 1, nullptr, true},  {"c", "C", 1, max_crossings, nullptr, true}};
  static constexpr const char* type = "WorldFormat";

  /// Types of the values, in a domain whose values carry their widths.
  template <class D>
  using Corner = typename D::sint;
  template <class D>
  using Point = typename D::sint;
  template <class D>
  using Slope = typename D::sint;
  template <class D>
  using DeterminantHigh = typename D::sint;
  template <class D>
  using DeterminantLow = typename D::uint;
  template <class D>
  using VolumeHigh = typename D::sint;
  template <class D>
  using VolumeLow = typename D::uint;
  template <class D>
  using EdgeHigh = typename D::sint;
  template <class D>
  using EdgeLow = typename D::uint;
  template <class D>
  using EdgeFlags = typename D::uint;

  /// Width of the origin, and of its difference to a corner.
  constexpr int point() const { return coord + finer; }
  /// Width of a direction component, -2^S..2^S.
  constexpr int direction() const { return slope + 2; }
  // Widths of the numbers of a triangle test. Each is a determinant of three vectors. If their components are
  // at most a, b and c, it is at most 4 a b c, and a b c is less than the product of powers of two here.
  constexpr int determinant() const { return 2 * coord + slope + 1; }
  constexpr int edge() const { return determinant() + finer; }
  constexpr int volume() const { return 3 * coord + finer; }
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

  /// Operands of a unit in this format.
  constexpr Operand corner(const char* name, Axis axis, int number) const {
    return {name, Role::corner, axis, Kind::integer, coord, -largest_corner(), largest_corner(), number};
  }
  constexpr Operand origin(const char* name) const {
    return integer_operand(name, Role::origin, Axis::none, point(), largest_point());
  }
  constexpr Operand slope_of(const char* name) const {
    return integer_operand(name, Role::direction, Axis::none, direction(), one());
  }

  /// The program takes this format.
  constexpr bool valid() const { return proved() && coord >= min_coord && slope >= min_slope; }
  constexpr bool proved() const {
    return coord >= min_proved_coord && coord <= max_coord && finer >= 0 && finer <= max_finer &&
           slope >= min_proved_slope && slope <= max_slope && fraction >= 0 && fraction <= max_fraction &&
           weights >= 0 && weights <= 1 && crossings >= 0 && crossings <= max_crossings;
  }
  friend constexpr bool operator==(const WorldBits& a, const WorldBits& b) {
    return a.coord == b.coord && a.finer == b.finer && a.slope == b.slope && a.fraction == b.fraction &&
           a.weights == b.weights && a.crossings == b.crossings;
  }
};

/// The same with widths known when the code is compiled: WorldFormat<20, 1, 20> is 20+1s20.
template <int N, int G, int S, int Fraction = 0, int Weights = 0, int Crossings = 0>
struct WorldFormat {
  static constexpr WorldBits bits{N, G, S, Fraction, Weights, Crossings};
  static_assert(bits.proved(), "there is no such format n+gsS");

  Width<N> coord{};
  Width<G> finer{};
  Width<S> slope{};
  Width<Fraction> fraction{};
  Width<Crossings> crossings{};

  template <class D>
  using Corner = typename D::template sint<N>;
  template <class D>
  using Point = typename D::template sint<bits.point()>;
  template <class D>
  using Slope = typename D::template sint<bits.direction()>;
  template <class D>
  using DeterminantHigh = typename D::template sint<bits.determinant() - bits.determinant() / 2>;
  template <class D>
  using DeterminantLow = typename D::template uint<bits.determinant() / 2>;
  template <class D>
  using VolumeHigh = typename D::template sint<bits.volume() - bits.volume() / 2>;
  template <class D>
  using VolumeLow = typename D::template uint<bits.volume() / 2>;
  template <class D>
  using EdgeHigh = typename D::template sint<bits.edge() - bits.edge() / 2>;
  template <class D>
  using EdgeLow = typename D::template uint<bits.edge() / 2>;
  template <class D>
  using EdgeFlags = typename D::template uint<3>;

  constexpr Width<bits.point()> point() const { return {}; }
  constexpr Width<bits.direction()> direction() const { return {}; }
  constexpr Width<bits.determinant()> determinant() const { return {}; }
  constexpr Width<bits.edge()> edge() const { return {}; }
  constexpr Width<bits.volume()> volume() const { return {}; }
  constexpr Width<bits.distance()> distance() const { return {}; }
  constexpr operator WorldBits() const { return bits; }
};

}  // namespace hls
}  // namespace hitpipe
