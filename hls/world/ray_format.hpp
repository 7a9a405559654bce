// The number format of the door of the integer world (docs/integer_world.md): "n+g/pfBsStF", e.g. 20+1/11s20.
// A ray in this format is one for triangle units in n+gsStF (WorldBits) and for box units in n+g/pfBsS
// (MajorBits).
//   n  bits of a corner, 8..24; [-1, 1] is -G..G with G = 2^(n-2) - 1
//   g  bits by which the ray's origin is finer than the corners, 0..3
//   p  bits of a mantissa, 4..32
//   B  bits of a box distance below the corners' unit, -2..3, at most g + F; 0 unless it is given. It says
//      how many bits of the length a box unit takes. No other number depends on it.
//   S  bits of a slope, 8..32
//   F  bits of a distance T below the unit of the origin's grid, 0..8; 0 unless it is given
#pragma once

#include <cstdint>

#include "hls/box/format.hpp"
#include "hls/box/major_format.hpp"
#include "hls/num/width.hpp"
#include "hls/world/world_format.hpp"

namespace hitpipe {
namespace hls {

/// A format whose widths are known at run time.
struct RayBits {
  int coord = 20;        ///< n
  int finer = 1;         ///< g
  int mantissa = 11;     ///< p
  int box_fraction = 0;  ///< B
  int slope = 20;        ///< S
  int fraction = 0;      ///< F

  static constexpr FormatField fields[] = {
      {"", "n", WorldBits::min_coord, WorldBits::max_coord},
      {"+", "g", 0, WorldBits::max_finer},
      {"/", "p", MajorBits::min_mantissa, MajorBits::max_mantissa},
      {"f", "B", MajorBits::min_fraction, MajorBits::max_fraction, nullptr, true},
      {"s", "S", WorldBits::min_slope, WorldBits::max_slope},
      {"t", "F", 1, WorldBits::max_fraction, nullptr, true}};
  static constexpr const char* condition = "B at most g+F";
  static constexpr const char* type = "RayFormat";

  /// Types of the values, in a domain whose values carry their widths. A pattern is a binary32's.
  template <class D>
  using Pattern = typename D::uint;
  template <class D>
  using Remainder = typename D::uint;
  template <class D>
  using Point = typename D::sint;
  template <class D>
  using Slope = typename D::uint;
  template <class D>
  using Mantissa = typename D::uint;
  template <class D>
  using Exponent = typename D::uint;
  template <class D>
  using Length = typename D::uint;

  /// Of the triangle unit, and of the box unit.
  constexpr WorldBits world() const { return {coord, finer, slope, fraction, 0}; }
  constexpr MajorBits boxes() const { return {coord, finer, mantissa, box_fraction, slope}; }

  constexpr int point() const { return world().point(); }
  /// Width of an exponent: 0 .. n+g-1.
  constexpr int exponent() const { return boxes().exponent(); }
  /// Width of the length.
  constexpr int distance() const { return world().distance(); }
  /// Width of a remainder in both divisions: twice a binary32's mantissa, and twice a slope.
  constexpr int remainder() const { return max(25, slope + 2); }

  constexpr bool valid() const { return world().valid() && boxes().valid() && takes_boxes(); }
  constexpr bool proved() const { return world().proved() && boxes().proved() && takes_boxes(); }
  friend constexpr bool operator==(const RayBits& a, const RayBits& b) {
    return a.coord == b.coord && a.finer == b.finer && a.mantissa == b.mantissa &&
           a.box_fraction == b.box_fraction && a.slope == b.slope && a.fraction == b.fraction;
  }

 private:
  constexpr bool takes_boxes() const { return box_fraction <= finer + fraction; }
};

/// The same with widths known when the code is compiled: RayFormat<20, 1, 11, 0, 20> is 20+1/11s20.
template <int N, int G, int P, int BoxFraction, int S, int Fraction = 0>
struct RayFormat {
  static constexpr RayBits bits{N, G, P, BoxFraction, S, Fraction};
  static_assert(bits.proved(), "there is no such format n+g/pfBsStF");

  Width<N> coord{};
  Width<G> finer{};
  Width<P> mantissa{};
  Width<S> slope{};
  Width<Fraction> fraction{};

  template <class D>
  using Pattern = typename D::template uint<32>;
  template <class D>
  using Remainder = typename D::template uint<bits.remainder()>;
  template <class D>
  using Point = typename D::template sint<bits.point()>;
  template <class D>
  using Slope = typename D::template uint<S + 1>;
  template <class D>
  using Mantissa = typename D::template uint<P>;
  template <class D>
  using Exponent = typename D::template uint<bits.exponent()>;
  template <class D>
  using Length = typename D::template uint<bits.distance()>;

  constexpr Width<bits.point()> point() const { return {}; }
  constexpr Width<bits.exponent()> exponent() const { return {}; }
  constexpr Width<bits.distance()> distance() const { return {}; }
  constexpr Width<bits.remainder()> remainder() const { return {}; }
  constexpr operator RayBits() const { return bits; }
};

}  // namespace hls
}  // namespace hitpipe
