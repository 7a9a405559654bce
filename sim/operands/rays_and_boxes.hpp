// Rays and boxes of CSV files. A ray is rounded to the nearest binary32; a box is rounded outward, so that
// the binary32 box holds the box as written.
#pragma once

#include <array>

#include "sim/operands/number_file.hpp"
#include "sim/operands/placement.hpp"
#include "sw_ref/scene/aabb.hpp"
#include "sw_ref/scene/ray.hpp"

namespace hitpipe::sim {

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
