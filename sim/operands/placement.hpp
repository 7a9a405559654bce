// Where rays and boxes lie: in the cube [-1, 1], or in a user's own units, which one scale and one offset
// move into the cube as they do with a scene (sw_ref/scene/normalise.hpp). With own units an origin is
// computed in double and rounded to binary32 once; a plane is rounded outward from the exact number. A
// direction stays as it is. A length is a multiple of the direction, so it is scaled.
#pragma once

#include <optional>

#include "sim/operands/number.hpp"
#include "sw_ref/scene/normalise.hpp"

namespace hitpipe::sim {

class Placement {
 public:
  /// Rays and boxes are in the cube.
  Placement() = default;
  /// The bounds are mapped to +-(1 - 2^-10). Throws std::runtime_error, one line, unless they are finite, the
  /// lower ones are not above the upper ones, and numbers and longest side are in the range of binary32.
  explicit Placement(const ref::Bounds& bounds);

  /// Scale 1 and offset 0 without bounds.
  [[nodiscard]] const ref::Normalisation& transform() const { return transform_; }
  [[nodiscard]] bool has_bounds() const { return has_bounds_; }

  /// Where a coordinate in the user's units lies in the cube, in double.
  [[nodiscard]] double place(double own, int axis) const;
  /// A binary32 on this side of the place of `own`; the nearest one, except in doubt.
  [[nodiscard]] float plane(double own, int axis, Rounding side) const;
  [[nodiscard]] double length(double own) const { return own * transform_.scale; }
  /// The coordinates on an axis that lie in the cube.
  [[nodiscard]] double least(int axis) const { return transform_.offset[axis] - 1.0 / transform_.scale; }
  [[nodiscard]] double most(int axis) const { return transform_.offset[axis] + 1.0 / transform_.scale; }

 private:
  ref::Normalisation transform_;
  bool has_bounds_ = false;
};

}  // namespace hitpipe::sim
