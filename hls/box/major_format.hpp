// The number format of a major-axis unit: "n+g/p", e.g. 20+1/13, or "n+g/pfF" with F fraction bits. With "sS"
// behind it, e.g. 20+1/11s20, it is a format of the integer world (docs/integer_world.md).
//   n  bits of a plane, 6..32
//   g  bits by which the ray's origin is finer than the planes, 0..3
//   p  bits of a mantissa, 4..32; n + g + p is at most 63
//   F  bits of a distance below the planes' unit, -2..3; 0 unless it is given
//   S  bits of a slope of the ray, 8..32. With it, corners and rays are integers: boxes do not grow, and the
//      far difference is one unit of the origin's grid more, which hits a box whose face holds the ray.
#pragma once

#include <cstdint>

#include "hls/box/format.hpp"
#include "hls/box/operand.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// A format whose widths are known at run time.
struct MajorBits {
  static constexpr int min_coord = 6;
  static constexpr int max_coord = 32;
  static constexpr int max_finer = 3;
  static constexpr int min_mantissa = 4;
  static constexpr int max_mantissa = 32;
  static constexpr int min_fraction = -2;
  static constexpr int max_fraction = 3;
  static constexpr int min_slope = 8;
  static constexpr int max_slope = 32;
  /// n + g + p: the bits of a product.
  static constexpr int max_product = 63;
  /// Exhaustive tests use smaller formats than the program. The proofs hold for them too.
  static constexpr int min_proved_coord = 4;
  static constexpr int min_proved_mantissa = 3;

  int coord = 20;     ///< n
  int finer = 1;      ///< g
  int mantissa = 13;  ///< p
  int fraction = 0;   ///< F
  int slope = 0;      ///< S; 0 in the float world

  static constexpr FormatField fields[] = {{"", "n", min_coord, max_coord},
                                           {"+", "g", 0, max_finer},
                                           {"/", "p", min_mantissa, max_mantissa},
                                           {"f", "F", min_fraction, max_fraction, nullptr, true},
                                           {"s", "S", min_slope, max_slope, nullptr, true}};
  static constexpr const char* condition = "n+g+p at most 63";
  static constexpr const char* type = "MajorFormat";

  /// Types of the values, in a domain whose values carry their widths.
  template <class D>
  using Plane = typename D::sint;
  template <class D>
  using Point = typename D::sint;
  template <class D>
  using Mantissa = typename D::uint;
  template <class D>
  using Exponent = typename D::uint;
  template <class D>
  using Distance = typename D::sint;
  template <class D>
  using Length = typename D::sint;

  /// Width of the origin, and of its difference to a plane.
  constexpr int point() const { return coord + finer; }
  /// Width of an exponent: 0 .. n+g-1.
  constexpr int exponent() const { return count_bits(point()); }
  /// Low product bits that are below the last bit of a distance.
  constexpr int trimmed() const { return mantissa - 1 + finer - fraction; }
  /// Width of a distance. Its magnitude is at most 2 (2^(n-1) - 1) 2^F.
  constexpr int distance() const { return coord + fraction + 1; }
  /// Width of the ray's length. Distances inside the cube have one bit less than others.
  constexpr int length() const { return coord + fraction; }

  /// G, the grid of planes: [-1, 1] is -G..G.
  constexpr std::int64_t largest_point() const { return (std::int64_t{1} << (coord - 2)) - 1; }
  /// The largest distance in the cube, and the length of a ray without an end.
  constexpr std::int64_t largest_length() const { return (std::int64_t{1} << (length() - 1)) - 1; }
  constexpr int largest_exponent() const { return point() - 1; }
  constexpr std::int64_t largest_mantissa() const { return (std::int64_t{1} << mantissa) - 1; }

  /// Operands of a unit in this format. The origin is mirrored: x, or -x - 1 on an axis where the direction
  /// is negative. In the integer world it is negated: -x, or x + 1.
  constexpr Operand origin(const char* name) const {
    const std::int64_t limit = largest_point() << finer;
    const bool negated = slope > 0;
    return {name,
            Role::origin,
            Axis::none,
            Kind::integer,
            point(),
            -limit - (negated ? 0 : 1),
            limit + (negated ? 1 : 0),
            0};
  }
  constexpr Operand plane(const char* name, Role role, Axis axis) const {
    return integer_operand(name, role, axis, coord, largest_point() + 1);
  }
  constexpr Operand mantissa_bound(const char* name, Role role) const {
    return {name,
            role,
            Axis::none,
            Kind::natural,
            mantissa,
            (std::int64_t{1} << (mantissa - 1)) - (role == Role::inverse_low ? 1 : 0),
            largest_mantissa(),
            0};
  }
  constexpr Operand exponent_of(const char* name) const {
    return {name, Role::exponent, Axis::none, Kind::natural, exponent(), 0, largest_exponent(), 0};
  }
  /// A distance in the cube.
  constexpr Operand inner_distance(const char* name, Role role) const {
    return {name, role, Axis::none, Kind::integer, length(), 0, largest_length(), 0};
  }

  /// The program takes this format.
  constexpr bool valid() const {
    return proved() && coord >= min_coord && mantissa >= min_mantissa && (slope == 0 || slope >= min_slope);
  }
  /// The pipelines and the ray set-up are proved in this format.
  constexpr bool proved() const {
    return coord >= min_proved_coord && coord <= max_coord && finer >= 0 && finer <= max_finer &&
           mantissa >= min_proved_mantissa && mantissa <= max_mantissa && fraction >= min_fraction &&
           fraction <= max_fraction && trimmed() >= 0 && point() + mantissa <= max_product && slope >= 0 &&
           slope <= max_slope;
  }
  friend constexpr bool operator==(const MajorBits& a, const MajorBits& b) {
    return a.coord == b.coord && a.finer == b.finer && a.mantissa == b.mantissa && a.fraction == b.fraction &&
           a.slope == b.slope;
  }
};

/// The same with widths known when the code is compiled: MajorFormat<20, 1, 13> is 20+1/13.
template <int N, int G, int P, int Fraction = 0, int Slope = 0>
struct MajorFormat {
  static constexpr MajorBits bits{N, G, P, Fraction, Slope};
  static_assert(bits.proved(), "there is no such format n+g/p");

  Width<N> coord{};
  Width<G> finer{};
  Width<P> mantissa{};
  Width<Fraction> fraction{};
  Width<Slope> slope{};

  template <class D>
  using Plane = typename D::template sint<N>;
  template <class D>
  using Point = typename D::template sint<bits.point()>;
  template <class D>
  using Mantissa = typename D::template uint<P>;
  template <class D>
  using Exponent = typename D::template uint<bits.exponent()>;
  template <class D>
  using Distance = typename D::template sint<bits.distance()>;
  template <class D>
  using Length = typename D::template sint<bits.length()>;

  constexpr Width<bits.point()> point() const { return {}; }
  constexpr Width<bits.exponent()> exponent() const { return {}; }
  constexpr Width<bits.trimmed()> trimmed() const { return {}; }
  constexpr Width<bits.distance()> distance() const { return {}; }
  constexpr Width<bits.length()> length() const { return {}; }
  constexpr operator MajorBits() const { return bits; }
};

}  // namespace hls
}  // namespace hitpipe
