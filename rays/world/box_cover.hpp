// A few boxes that together hold a mesh, for maps: what holds the moved boxes holds the moved mesh, and is smaller than
// what the moved box of the whole mesh would be.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "rays/world/grid_map.hpp"
#include "rays/world/int_box.hpp"

namespace hitpipe::ref {

class BoxCover {
 public:
  static constexpr std::size_t most = 8;

  /// 1 to `most` boxes.
  explicit BoxCover(std::span<const IntBox> boxes);

  /// The least and the most that holds all corners in the boxes after they are moved and rounded.
  [[nodiscard]] std::array<GridMap::Place, 2> places(const GridMap& map) const;

 private:
  /// By axis and box, in halves of the grid's unit, so that all are whole: no sum of six products has more than 52 bits,
  /// and binary64 holds it. Places without a box of their own have the last one.
  std::array<std::array<double, most>, 3> middle_{}, half_side_{};
};

}  // namespace hitpipe::ref
