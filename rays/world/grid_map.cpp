#include "rays/world/grid_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/exact/quick_numbers.hpp"
#include "rays/world/int128.hpp"

namespace hitpipe::ref {

namespace {

bool all_even(const GridMap::Rows& rows) {
  for (const auto& row : rows)
    for (const std::int32_t a : row)
      if (a % 2 != 0) return false;
  return true;
}

}  // namespace

GridMap::Place GridMap::place(const IntTriangle::Corner& corner) const {
  Place placed{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::int64_t sum = half();
    for (std::size_t j = 0; j < 3; ++j) sum += std::int64_t{matrix[k][j]} * corner[j];
    placed[k] = (sum >> fraction) + move[k];
  }
  return placed;
}

IntTriangle::Corner GridMap::operator()(const IntTriangle::Corner& corner) const {
  const Place placed = place(corner);
  return {static_cast<std::int32_t>(placed[0]), static_cast<std::int32_t>(placed[1]),
          static_cast<std::int32_t>(placed[2])};
}

std::array<GridMap::Place, 2> GridMap::places(const IntBox& box) const {
  std::array<Place, 2> placed{};
  for (std::size_t k = 0; k < 3; ++k) {
    std::int64_t low = half();
    std::int64_t high = low;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::int64_t one = std::int64_t{matrix[k][j]} * box.min[j];
      const std::int64_t other = std::int64_t{matrix[k][j]} * box.max[j];
      low += std::min(one, other);
      high += std::max(one, other);
    }
    placed[0][k] = (low >> fraction) + move[k];
    placed[1][k] = (high >> fraction) + move[k];
  }
  return placed;
}

IntBox GridMap::operator()(const IntBox& box) const {
  const auto [least, most] = places(box);
  IntBox placed;
  for (std::size_t k = 0; k < 3; ++k) {
    placed.min[k] = static_cast<std::int32_t>(least[k]);
    placed.max[k] = static_cast<std::int32_t>(most[k]);
  }
  return placed;
}

bool GridMap::mirrors() const {
  const auto& a = matrix;
  Int128 det = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t p = (j + 1) % 3, q = (j + 2) % 3;
    det += static_cast<Int128>(a[0][j]) * (std::int64_t{a[1][p]} * a[2][q] - std::int64_t{a[1][q]} * a[2][p]);
  }
  return det < 0;
}

bool GridMap::is_lattice() const {
  std::int32_t size = 0;
  unsigned columns = 0;
  for (const auto& row : matrix) {
    unsigned there = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      if (row[j] == 0) continue;
      if (size == 0) size = std::abs(row[j]);
      if (std::abs(row[j]) != size) return false;
      ++there;
      columns |= 1U << j;
    }
    if (there != 1) return false;
  }
  return columns == 7 && (size & (size - 1)) == 0;
}

GridMap grid_map(const std::array<std::array<double, 3>, 3>& matrix, const std::array<double, 3>& move) {
  double largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (!std::isfinite(matrix[k][j]))
        throw std::out_of_range(fmt::format("the matrix has {} in row {}, column {}; numbers must be finite",
                                            matrix[k][j], k + 1, j + 1));
      largest = std::max(largest, std::abs(matrix[k][j]));
    }
    if (!(std::abs(move[k]) <= 0x1p23))
      throw std::out_of_range(fmt::format("a move of {} units of the grid along {}; allowed is -2^23 to 2^23",
                                          move[k], "xyz"[k]));
  }
  if (largest > GridMap::largest_coefficient)
    throw std::out_of_range(fmt::format("the matrix has {} in units of the grid; allowed is up to {} in size",
                                        largest, GridMap::largest_coefficient));
  GridMap made;
  made.fraction = std::min(GridMap::most_fraction, GridMap::coefficient_bits - 2 - exponent_of(largest));
  while (nearest(largest * power_of_two(made.fraction)) > GridMap::largest_coefficient) --made.fraction;
  const double scale = power_of_two(made.fraction);
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t j = 0; j < 3; ++j)
      made.matrix[k][j] = static_cast<std::int32_t>(nearest(matrix[k][j] * scale));
    made.move[k] = static_cast<std::int32_t>(nearest(move[k]));
  }
  while (made.fraction > 0 && all_even(made.matrix)) {
    for (auto& row : made.matrix)
      for (std::int32_t& a : row) a /= 2;
    --made.fraction;
  }
  return made;
}

}  // namespace hitpipe::ref
