// GridMap for four triangles at once. Every number is exact in a double: coefficients have 24 bits and corners 23, and
// 2^-f moves none of them.
#pragma once

#include <cstddef>
#include <cstring>

#include "rays/trace/triangle_pack.hpp"

namespace hitpipe::ref {

struct CornerMap {
  double matrix[3][3] = {};  ///< A / 2^f
  double move[3] = {};       ///< tau + h / 2^f
  bool mirrors = false;      ///< corners 1 and 2 are exchanged

  /// Numbers of triangles stay.
  template <class Lanes>
  void place(const TrianglePack& pack, TrianglePack& placed) const {
    static_assert(Lanes::count == TrianglePack::size);
    using Floats = typename Lanes::Floats;
    using Doubles = double __attribute__((vector_size(32)));
    Floats least[3], most[3];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      Doubles from[3];
      for (std::size_t j = 0; j < 3; ++j) {
        Floats row;
        std::memcpy(&row, pack.corners[3 * corner + j], sizeof row);
        from[j] = __builtin_convertvector(row, Doubles);
      }
      const std::size_t to = mirrors && corner > 0 ? 3 - corner : corner;
      for (std::size_t k = 0; k < 3; ++k) {
        const Doubles sum =
            from[0] * matrix[k][0] + from[1] * matrix[k][1] + from[2] * matrix[k][2] + move[k];
        // Below 2^51 in size, so that adding 1.5 2^52 leaves no bit below 1.
        const Doubles nearest = (sum + 0x1.8p52) - 0x1.8p52;
        const Floats row = __builtin_convertvector(nearest > sum ? nearest - 1.0 : nearest, Floats);
        std::memcpy(placed.corners[3 * to + k], &row, sizeof row);
        least[k] = corner == 0 ? row : row < least[k] ? row : least[k];
        most[k] = corner == 0 ? row : row > most[k] ? row : most[k];
      }
    }
    Floats longest = most[0] - least[0];
    for (std::size_t k = 1; k < 3; ++k) {
      const Floats side = most[k] - least[k];
      longest = side > longest ? side : longest;
    }
    std::memcpy(placed.longest_side, &longest, sizeof longest);
    std::memcpy(placed.triangles, pack.triangles, sizeof pack.triangles);
  }
};

}  // namespace hitpipe::ref
