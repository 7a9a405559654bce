// Cells over some corners of a polygon, so that only near ones are looked at.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace hitpipe::ref {

class CornerGrid {
 public:
  /// What becomes of a corner that was visited: it stays, it goes, or it stays and the visit ends.
  enum Answer : std::uint8_t { keep, remove, stop };

  CornerGrid() = default;
  CornerGrid(std::span<const glm::dvec2> points, const std::vector<std::uint32_t>& corners)
      : points_(points), is_in_(points.size(), false) {
    glm::dvec2 low = points[0];
    glm::dvec2 high = low;
    for (const glm::dvec2& p : points) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    low_ = low;
    const glm::dvec2 size = high - low;
    // About one corner a cell, cells as square as the box allows.
    const double wanted = std::max<double>(1.0, static_cast<double>(corners.size()));
    const double shape = size.x > 0.0 && size.y > 0.0 ? size.x / size.y : 1.0;
    columns_ = static_cast<std::size_t>(std::clamp(std::sqrt(wanted * shape), 1.0, wanted));
    rows_ = static_cast<std::size_t>(std::clamp(wanted / static_cast<double>(columns_), 1.0, wanted));
    per_x_ = size.x > 0.0 ? static_cast<double>(columns_) / size.x : 0.0;
    per_y_ = size.y > 0.0 ? static_cast<double>(rows_) / size.y : 0.0;
    cells_.resize(columns_ * rows_);
    for (const std::uint32_t corner : corners) put_back(corner);
  }

  void put_back(std::uint32_t corner) {
    if (is_in_[corner]) return;
    is_in_[corner] = true;
    const glm::dvec2& p = points_[corner];
    cells_[row(p.y) * columns_ + column(p.x)].push_back(corner);
  }

  /// Calls `see` for all corners in the box and some near it. False if it stopped.
  template <class See>
  bool visit(const glm::dvec2& low, const glm::dvec2& high, See&& see) {
    const std::size_t last_column = column(high.x);
    const std::size_t last_row = row(high.y);
    for (std::size_t y = row(low.y); y <= last_row; ++y) {
      for (std::size_t x = column(low.x); x <= last_column; ++x) {
        std::vector<std::uint32_t>& cell = cells_[y * columns_ + x];
        for (std::size_t k = 0; k < cell.size();) {
          const Answer answer = see(cell[k]);
          if (answer == stop) return false;
          if (answer == keep) {
            ++k;
            continue;
          }
          is_in_[cell[k]] = false;
          cell[k] = cell.back();
          cell.pop_back();
        }
      }
    }
    return true;
  }

 private:
  // Rounding is monotonic, so a point in a box is in a cell between those of the box's corners.
  [[nodiscard]] std::size_t column(double x) const {
    return std::min(static_cast<std::size_t>((x - low_.x) * per_x_), columns_ - 1);
  }
  [[nodiscard]] std::size_t row(double y) const {
    return std::min(static_cast<std::size_t>((y - low_.y) * per_y_), rows_ - 1);
  }

  std::span<const glm::dvec2> points_;
  std::vector<bool> is_in_;
  std::vector<std::vector<std::uint32_t>> cells_;
  glm::dvec2 low_{0.0};
  double per_x_ = 0.0;
  double per_y_ = 0.0;
  std::size_t columns_ = 1;
  std::size_t rows_ = 1;
};

}  // namespace hitpipe::ref
