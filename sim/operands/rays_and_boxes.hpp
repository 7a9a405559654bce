// Rays and boxes of CSV files. A ray is rounded to the nearest binary32; a box is rounded outward, so that
// the binary32 box holds the box as written.
//
// They lie in the cube [-1, 1], or in a user's own units. One scale and one offset move those into the cube, as
// they do with a scene (rays/scene/normalise.hpp): an origin is computed in double and rounded to binary32
// once, a plane is rounded outward from the exact number, a direction stays as it is, and a length, which is a
// multiple of the direction, is scaled.
#pragma once

#include <array>
#include <optional>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/scene/normalise.hpp"
#include "sim/operands/number_file.hpp"

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

/// Columns ox,oy,oz,dx,dy,dz[,length]. A length is a multiple of the direction; a ray without one has no end.
class RayFile {
 public:
  RayFile(const std::string& file, const Placement& placement);

  [[nodiscard]] NumberFile& lines() { return lines_; }
  /// The ray in the cube. Throws std::runtime_error, one line that names file and line, unless the unit takes
  /// it. Any thread may ask.
  [[nodiscard]] ref::Ray ray(const NumberLine& line) const;

 private:
  [[nodiscard]] double number(const NumberLine& line, std::size_t column, std::string_view word) const;
  [[nodiscard]] float length(const NumberLine& line, std::string_view word) const;

  Placement placement_;
  NumberFile lines_;
};

/// One or two boxes.
using Boxes = std::array<ref::Aabb, 2>;

/// min_x,min_y,min_z,max_x,max_y,max_z; with two boxes a line, min_x_0,...,max_z_1.
[[nodiscard]] std::vector<std::string> box_columns(std::size_t boxes_per_line);

/// Has those columns.
class BoxFile {
 public:
  BoxFile(const std::string& file, const Placement& placement, std::size_t boxes_per_line);

  [[nodiscard]] NumberFile& lines() { return lines_; }
  /// The boxes of a line, in the cube. Throws as RayFile::ray() does. Any thread may ask.
  [[nodiscard]] Boxes boxes(const NumberLine& line) const;

 private:
  [[nodiscard]] float plane(const NumberLine& line, std::size_t column, std::string_view word) const;

  Placement placement_;
  std::size_t boxes_per_line_;
  NumberFile lines_;
};

}  // namespace hitpipe::sim
