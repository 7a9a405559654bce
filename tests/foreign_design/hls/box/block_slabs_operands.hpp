// The operands of block_slabs and their format "bNmM": coordinates of N bits on the integer grid, and planes
// of a box as mantissas of M bits with one exponent for the box. A plane is mantissa << exponent.
#pragma once

#include "hls/box/format.hpp"
#include "hls/box/operand.hpp"
#include "hls/num/width.hpp"

namespace hitpipe {
namespace hls {

struct BlockBits {
  int coord = 16;     ///< N
  int mantissa = 10;  ///< M

  static constexpr FormatField fields[] = {{"b", "N", 6, 24}, {"m", "M", 4, 23, "N-1"}};

  /// Exponents are 0..N-M.
  constexpr int exponent() const { return count_bits(coord - mantissa + 1); }
  constexpr int product() const { return 2 * coord - 1; }
  /// Origins and planes lie in -G-1..G+1, so a difference has N bits. G is as in ref::quantise_box().
  constexpr std::int64_t largest_point() const { return (std::int64_t{1} << (coord - 2)) - 1; }
  constexpr std::int64_t largest_component() const { return (std::int64_t{1} << (coord - 1)) - 1; }
  constexpr std::int64_t largest_mantissa() const { return (std::int64_t{1} << (mantissa - 1)) - 1; }

  constexpr bool valid() const { return mantissa < coord; }

  constexpr Operand plane(const char* name, Role role, Axis axis) const {
    return {name, role, axis, Kind::integer, mantissa, -largest_mantissa() - 1, largest_mantissa(), 0};
  }
};

/// Calls visit(Operand, field) for every port. `Self` may be const.
template <class D, class F>
struct BlockSlabsOperands {
  using sint = typename D::sint;

  sint rx, ry, rz;            ///< ray origin on the grid
  sint inv_x, inv_y, inv_z;   ///< floor of the scaled inverse direction
  typename D::uint exponent;  ///< of the box's six planes
  sint xmin, xmax, ymin, ymax, zmin, zmax;

  template <class Self, class Visit>
  static constexpr void for_each(const BlockBits& format, Self& self, Visit&& visit) {
    const auto point = [&](const char* name, Axis axis) {
      return integer_operand(name, Role::origin, axis, format.coord, format.largest_point());
    };
    const auto inverse = [&](const char* name, Axis axis) {
      return integer_operand(name, Role::inverse_low, axis, format.coord, format.largest_component());
    };
    visit(point("rx", Axis::x), self.rx);
    visit(point("ry", Axis::y), self.ry);
    visit(point("rz", Axis::z), self.rz);
    visit(inverse("inv_x", Axis::x), self.inv_x);
    visit(inverse("inv_y", Axis::y), self.inv_y);
    visit(inverse("inv_z", Axis::z), self.inv_z);
    visit(Operand{"exponent", Role::other, Axis::none, Kind::natural, format.exponent(), 0,
                  format.coord - format.mantissa, 0},
          self.exponent);
    visit(format.plane("xmin", Role::plane_low, Axis::x), self.xmin);
    visit(format.plane("xmax", Role::plane_high, Axis::x), self.xmax);
    visit(format.plane("ymin", Role::plane_low, Axis::y), self.ymin);
    visit(format.plane("ymax", Role::plane_high, Axis::y), self.ymax);
    visit(format.plane("zmin", Role::plane_low, Axis::z), self.zmin);
    visit(format.plane("zmax", Role::plane_high, Axis::z), self.zmax);
  }
};

}  // namespace hls
}  // namespace hitpipe
