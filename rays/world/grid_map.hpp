// Where an instance puts the corners of its mesh (docs/instances.md): a map of the grid into itself, rounded once for
// each corner. So corners that are equal stay equal, and a mesh that is closed stays closed.
#pragma once

#include <array>
#include <cstdint>

#include "rays/world/int_box.hpp"
#include "rays/world/int_mesh.hpp"

namespace hitpipe::ref {

/// w = floor((A v + h) / 2^f) + tau, with h = 2^(f-1), or 0 where f = 0.
struct GridMap {
  static constexpr int coefficient_bits = 24;  ///< of A, with sign; -(2^23 - 1)..2^23 - 1
  static constexpr int most_fraction = 24;
  static constexpr std::int32_t largest_coefficient = (1 << (coefficient_bits - 1)) - 1;
  using Rows = std::array<std::array<std::int32_t, 3>, 3>;
  using Place = std::array<std::int64_t, 3>;

  Rows matrix{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< A
  int fraction = 0;                                ///< f, 0..24
  IntTriangle::Corner move{};                      ///< tau, in units of the world's grid

  /// h.
  [[nodiscard]] std::int64_t half() const { return fraction > 0 ? std::int64_t{1} << (fraction - 1) : 0; }
  /// Of a corner of at most 24 bits. It may be anywhere.
  [[nodiscard]] Place place(const IntTriangle::Corner& corner) const;
  /// The world holds what it gives.
  [[nodiscard]] IntTriangle::Corner operator()(const IntTriangle::Corner& corner) const;
  /// The least and the most that holds all corners in the box after they are moved and rounded, as rounding is monotone.
  [[nodiscard]] std::array<Place, 2> places(const IntBox& box) const;

  /// The same for a box in the world.
  [[nodiscard]] IntBox operator()(const IntBox& box) const;

  /// det A < 0: what is outside of a mesh would be inside of it.
  [[nodiscard]] bool mirrors() const;
  /// A is one of the 48 symmetries of the grid times a power of two.
  [[nodiscard]] bool is_lattice() const;

  friend bool operator==(const GridMap&, const GridMap&) = default;
};

/// The map nearest to w = M v + t; `matrix` is by rows, and both are in units of the grid. f is the largest for which A
/// fits; then common factors of 2 go, so maps without a rounding have f = 0. A matrix that flattens is right. Throws
/// std::out_of_range, one line, for a number that is not finite, for a coefficient beyond 2^23 - 1, and for a move
/// beyond 2^23.
[[nodiscard]] GridMap grid_map(const std::array<std::array<double, 3>, 3>& matrix,
                               const std::array<double, 3>& move);

}  // namespace hitpipe::ref
