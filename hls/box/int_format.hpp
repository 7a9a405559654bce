// The number format of an integer ray-box unit: "n/t", as the thesis prints it (section 6.2.3), e.g. 24/24.
//   n  bits of a coordinate and of an inverse ray direction vector component (IRDVC), 6..32
//   t  bits kept of a distance product, whose significant width is 2n-1, 6..2n-1
#pragma once

#include <cstdint>

#include "hls/box/operand.hpp"

namespace hitpipe::hls {

/// An integer format whose widths are known at run time. Valid: see `valid()`.
struct IntBits {
  static constexpr int min_coord = 6;
  static constexpr int max_coord = 32;
  static constexpr int min_interval = 6;
  /// Below the program's formats, for exhaustive tests: the proofs of sw_ref/quantise hold for these too.
  static constexpr int min_proved = 4;

  int coord = 20;     ///< n
  int interval = 24;  ///< t

  /// Width of a product of a coordinate difference and an IRDVC: |product| <= (2^(n-1)-1)^2 < 2^(2n-2).
  [[nodiscard]] constexpr int product() const { return 2 * coord - 1; }
  /// Low product bits that are dropped before distances are compared.
  [[nodiscard]] constexpr int trimmed() const { return product() - interval; }
  /// G, the grid of coordinates: origins and endpoints of rays lie in -G..G.
  [[nodiscard]] constexpr std::int64_t largest_point() const { return (std::int64_t{1} << (coord - 2)) - 1; }
  /// Boxes are rounded outward, one further.
  [[nodiscard]] constexpr std::int64_t largest_plane() const { return std::int64_t{1} << (coord - 2); }
  /// M, the largest magnitude of a direction component and of an IRDVC.
  [[nodiscard]] constexpr std::int64_t largest_component() const {
    return (std::int64_t{1} << (coord - 1)) - 1;
  }
  /// The operands of units in this format.
  [[nodiscard]] constexpr Operand point(const char* name, Role role, Axis axis) const {
    return integer_operand(name, role, axis, coord, largest_point());
  }
  [[nodiscard]] constexpr Operand plane(const char* name, Role role, Axis axis) const {
    return integer_operand(name, role, axis, coord, largest_plane());
  }
  [[nodiscard]] constexpr Operand component(const char* name, Role role, Axis axis) const {
    return integer_operand(name, role, axis, coord, largest_component());
  }
  [[nodiscard]] constexpr Operand length(const char* name) const { return length_operand(name, interval); }

  /// A format of the program.
  [[nodiscard]] constexpr bool valid() const {
    return proved() && coord >= min_coord && interval >= min_interval;
  }
  /// A format of the pipelines and the ray set-up.
  [[nodiscard]] constexpr bool proved() const {
    return coord >= min_proved && coord <= max_coord && interval >= min_proved && interval <= product();
  }
  friend constexpr bool operator==(const IntBits&, const IntBits&) = default;
};

/// The same as a type, for the pipelines: IntFormat<24, 24> is the thesis's "24/24".
template <int N, int T>
struct IntFormat {
  static constexpr IntBits bits{N, T};
  static_assert(bits.proved(), "n/t must have n in 4..32 and t in 4..2n-1");
  static constexpr int coord = N;
  static constexpr int interval = T;
  static constexpr int product = bits.product();
  static constexpr int trimmed = bits.trimmed();
};

}  // namespace hitpipe::hls
