// The grid of one wide node: 8-bit planes from the node's own origin, with a power of two for a step on each
// axis (Ylitie, Karras, Laine 2017, section 3.1).
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "rays/mesh/aabb.hpp"
#include "rays/tree/relative_box.hpp"

namespace hitpipe::ref {

class LocalGrid {
 public:
  static constexpr std::uint32_t top = top_code<8>;
  using Exponents = std::array<std::uint8_t, 3>;  ///< biased as those of binary32, never 0

  LocalGrid(const glm::vec3& origin, const Exponents& exponents) : origin_(origin), exponents_(exponents) {}

  /// The finest grid from the box's min whose top code reaches its max.
  explicit LocalGrid(const Aabb& box) : origin_(box.min), exponents_{1, 1, 1} {
    for (int axis = 0; axis < 3; ++axis) {
      const float width = box.max[axis] - box.min[axis];
      std::uint8_t& exponent = exponents_[static_cast<std::size_t>(axis)];
      if (width > 0) exponent = static_cast<std::uint8_t>(std::max(std::ilogb(width / top) + bias - 1, 1));
      while (decoded(axis, top) < box.max[axis]) ++exponent;
    }
  }

  /// A code has 8 bits and a step one, so their product is exact; the sum is rounded once. It does not fall
  /// when the code rises, and code 0 is the origin. Whoever encodes compares this rounded sum with the plane.
  [[nodiscard]] float decoded(int axis, float code) const {
    return sum_of_product(origin_[axis], step(axis), code);
  }
  [[nodiscard]] float origin(int axis) const { return origin_[axis]; }
  [[nodiscard]] float step(int axis) const {
    return std::bit_cast<float>(std::uint32_t{exponents_[static_cast<std::size_t>(axis)]} << 23U);
  }
  [[nodiscard]] const Exponents& exponents() const { return exponents_; }

 private:
  static constexpr int bias = 127;

  glm::vec3 origin_;
  Exponents exponents_;
};

}  // namespace hitpipe::ref
