// The number format of an integer ray-box unit: "n/t", as the thesis prints it (section 6.2.3), e.g. 24/24.
//   n  bits of a coordinate and of an inverse ray direction vector component (IRDVC), 6..32
//   t  bits kept of a distance product, whose significant width is 2n-1, 6..2n-1
#pragma once

#include <cstdint>

#include "hls/box/format.hpp"
#include "hls/box/operand.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

/// An integer format whose widths are known at run time.
struct IntBits {
  static constexpr int min_coord = 6;
  static constexpr int max_coord = 32;
  static constexpr int min_interval = 6;
  /// Exhaustive tests use smaller formats than the program. The proofs of sw_ref/quantise hold for them too.
  static constexpr int min_proved = 4;

  int coord = 20;     ///< n
  int interval = 24;  ///< t

  static constexpr FormatField fields[] = {{"", "n", min_coord, max_coord},
                                           {"/", "t", min_interval, 2 * max_coord - 1, "2n-1"}};
  static constexpr const char* type = "IntFormat";

  /// Types of a coordinate and of a trimmed product, in a domain whose values carry their widths.
  template <class D>
  using Coord = typename D::sint;
  template <class D>
  using Interval = typename D::sint;

  /// Width of a product of a coordinate difference and an IRDVC: |product| <= (2^(n-1)-1)^2 < 2^(2n-2).
  constexpr int product() const { return 2 * coord - 1; }
  /// Low product bits that are dropped before distances are compared.
  constexpr int trimmed() const { return product() - interval; }
  /// G, the grid of coordinates: origins and endpoints of rays lie in -G..G.
  constexpr std::int64_t largest_point() const { return (std::int64_t{1} << (coord - 2)) - 1; }
  /// Boxes are rounded outward, so their planes reach one unit farther.
  constexpr std::int64_t largest_plane() const { return std::int64_t{1} << (coord - 2); }
  /// M, the largest magnitude of a direction component and of an IRDVC.
  constexpr std::int64_t largest_component() const { return (std::int64_t{1} << (coord - 1)) - 1; }
  /// Operands of a unit in this format.
  constexpr Operand point(const char* name, Role role, Axis axis) const {
    return integer_operand(name, role, axis, coord, largest_point());
  }
  constexpr Operand plane(const char* name, Role role, Axis axis) const {
    return integer_operand(name, role, axis, coord, largest_plane());
  }
  constexpr Operand component(const char* name, Role role, Axis axis) const {
    return integer_operand(name, role, axis, coord, largest_component());
  }
  constexpr Operand length(const char* name) const { return length_operand(name, interval); }

  /// The program takes this format.
  constexpr bool valid() const { return proved() && coord >= min_coord && interval >= min_interval; }
  /// The pipelines and the ray set-up are proved in this format.
  constexpr bool proved() const {
    return coord >= min_proved && coord <= max_coord && interval >= min_proved && interval <= product();
  }
  friend constexpr bool operator==(const IntBits& a, const IntBits& b) {
    return a.coord == b.coord && a.interval == b.interval;
  }
};

/// The same with widths known when the code is compiled: IntFormat<24, 24> is the thesis's "24/24".
template <int N, int T>
struct IntFormat {
  static constexpr IntBits bits{N, T};
  static_assert(bits.proved(), "n/t must have n in 4..32 and t in 4..2n-1");

  Width<N> coord{};
  Width<T> interval{};

  template <class D>
  using Coord = typename D::template sint<N>;
  template <class D>
  using Interval = typename D::template sint<T>;

  constexpr Width<bits.product()> product() const { return {}; }
  constexpr Width<bits.trimmed()> trimmed() const { return {}; }
  constexpr operator IntBits() const { return bits; }
};

}  // namespace hls
}  // namespace hitpipe
