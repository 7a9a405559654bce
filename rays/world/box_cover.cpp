#include "rays/world/box_cover.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hitpipe::ref {

BoxCover::BoxCover(std::span<const IntBox> boxes) {
  for (std::size_t i = 0; i < most; ++i) {
    const IntBox& box = boxes[std::min(i, boxes.size() - 1)];
    for (std::size_t j = 0; j < 3; ++j) {
      middle_[j][i] = static_cast<double>(box.max[j]) + box.min[j];
      half_side_[j][i] = static_cast<double>(box.max[j]) - box.min[j];
    }
  }
}

std::array<GridMap::Place, 2> BoxCover::places(const GridMap& map) const {
  std::array<GridMap::Place, 2> placed{};
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = map.matrix[k][0], y = map.matrix[k][1], z = map.matrix[k][2];
    const double size_x = std::abs(x), size_y = std::abs(y), size_z = std::abs(z);
    // Halved in separate steps, so that compilers use vectors.
    std::array<double, most> low{}, high{};
    for (std::size_t i = 0; i < most; ++i) {
      const double middle = x * middle_[0][i] + y * middle_[1][i] + z * middle_[2][i];
      const double side = size_x * half_side_[0][i] + size_y * half_side_[1][i] + size_z * half_side_[2][i];
      low[i] = middle - side;
      high[i] = middle + side;
    }
    std::array<double, most / 2> low_of_two{}, high_of_two{};
    for (std::size_t i = 0; i < most / 2; ++i) {
      low_of_two[i] = std::min(low[i], low[i + most / 2]);
      high_of_two[i] = std::max(high[i], high[i + most / 2]);
    }
    const auto whole = [&](double twice) {
      return ((static_cast<std::int64_t>(twice) / 2 + map.half()) >> map.fraction) + map.move[k];
    };
    placed[0][k] = whole(*std::min_element(low_of_two.begin(), low_of_two.end()));
    placed[1][k] = whole(*std::max_element(high_of_two.begin(), high_of_two.end()));
  }
  return placed;
}

}  // namespace hitpipe::ref
