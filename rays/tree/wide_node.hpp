// Nodes of 4 or 8 children, with the boxes of the children in the node. Those with 8-bit planes are the
// compressed wide nodes of Ylitie, Karras and Laine (Efficient Incoherent Ray Traversal on GPUs Through
// Compressed Wide BVHs, HPG 2017, section 3); those with binary32 planes have the same tree without loss.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rays/mesh/aabb.hpp"
#include "rays/tree/axis_codes.hpp"
#include "rays/tree/near_first_store.hpp"
#include "rays/tree/relative_box.hpp"

namespace hitpipe::ref {

/// 8-bit planes from the node's own origin, with a power of two for a step on each axis (section 3.1).
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

/// Of a leaf: CWBVH counts in unary with three bits.
inline constexpr int most_in_wide_leaf = 3;

/// The planes of a node's children, those of a kind side by side, so that all children are tested together:
/// min x, y, z, then max.
template <int width>
using ChildPlanes = std::array<std::array<float, width>, 6>;

/// Where the branches and the triangles among the children begin. They follow in the order of the children.
struct WidePointers {
  std::uint32_t nodes = 0;
  std::uint32_t triangles = 0;
};

/// 80 bytes with 8 children, as published. With 4 the same fields have 52 bytes, and the node 64: it is
/// aligned to 16 bytes as that of 80 is, so no node of 4 lies in two lines of 64 bytes.
template <int width_>
struct alignas(16) WideNode {
  static constexpr int width = width_;

  glm::vec3 origin;
  LocalGrid::Exponents exponents;
  std::uint8_t branches = 0;  ///< bit i: child i is a branch
  WidePointers first;
  /// 0: no child; branch: 32 + 24 + its place; leaf: count in unary in three bits, then the number of its
  /// first triangle in five.
  std::array<std::uint8_t, width> kinds{};
  std::array<std::array<std::uint8_t, width>, 6> planes{};  ///< min x, y, z, then max

  /// Each child lies in the box; each is decoded to a box that contains it.
  WideNode(const Aabb& box, std::span<const BoxedChild> children, WidePointers pointers)
      : WideNode(LocalGrid(box), pointers) {
    const LocalGrid grid(origin, exponents);
    std::uint32_t triangles = 0;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const BoxedChild& child = children[i];
      for (int axis = 0; axis < 3; ++axis) {
        const AxisCodes codes(grid, axis);
        const auto low = static_cast<std::size_t>(axis);
        planes[low][i] = static_cast<std::uint8_t>(codes.below(child.box.min[axis]));
        planes[low + 3][i] = static_cast<std::uint8_t>(codes.above(child.box.max[axis]));
      }
      if (child.is_branch()) {
        branches = static_cast<std::uint8_t>(branches | 1U << i);
        kinds[i] = static_cast<std::uint8_t>(32 + 24 + i);
      } else {
        kinds[i] = static_cast<std::uint8_t>(((1U << child.count) - 1) << 5U | triangles);
        triangles += static_cast<std::uint32_t>(child.count);
      }
    }
  }

  [[nodiscard]] unsigned children() const {
    unsigned count = 0;
    while (count < width && kinds[count] != 0) ++count;
    return count;
  }
  [[nodiscard]] ChildPlanes<width> decoded_planes() const {
    const LocalGrid grid(origin, exponents);
    ChildPlanes<width> decoded;
    for (std::size_t plane = 0; plane < 6; ++plane) {
      for (std::size_t i = 0; i < width; ++i)
        decoded[plane][i] = grid.decoded(static_cast<int>(plane % 3), planes[plane][i]);
    }
    return decoded;
  }
  [[nodiscard]] NodeRef child(std::size_t i) const {
    if ((branches >> i & 1U) != 0) {
      const auto before = static_cast<std::uint32_t>(std::popcount(branches & ((1U << i) - 1)));
      return {first.nodes + before, BoxedChild::branch};
    }
    return {first.triangles + (kinds[i] & 31U), std::popcount(static_cast<unsigned>(kinds[i] >> 5U))};
  }

 private:
  WideNode(const LocalGrid& grid, WidePointers pointers)
      : origin(grid.origin(0), grid.origin(1), grid.origin(2)),
        exponents(grid.exponents()),
        first(pointers) {}
};
static_assert(sizeof(WideNode<8>) == 80 && sizeof(WideNode<4>) == 64);

/// 128 bytes with 4 children, as AMD's box nodes of binary32 (radv_bvh_box32_node in Mesa), and twice that
/// with 8.
template <int width_>
struct alignas(64) WideFloatNode {
  static constexpr int width = width_;

  ChildPlanes<width> planes{};
  std::array<std::uint32_t, width> first{};
  std::array<std::int8_t, width> counts{};  ///< as BoxedChild::count
  std::uint8_t children_count = 0;

  WideFloatNode(const Aabb& /*box*/, std::span<const BoxedChild> children, WidePointers pointers)
      : children_count(static_cast<std::uint8_t>(children.size())) {
    for (std::size_t i = 0; i < children.size(); ++i) {
      const BoxedChild& child = children[i];
      for (unsigned plane = 0; plane < 6; ++plane) planes[plane][i] = child.box.plane(plane);
      counts[i] = static_cast<std::int8_t>(child.count);
      first[i] = child.is_branch() ? pointers.nodes : pointers.triangles;
      pointers.nodes += child.is_branch() ? 1 : 0;
      pointers.triangles += static_cast<std::uint32_t>(child.count);
    }
  }

  [[nodiscard]] unsigned children() const { return children_count; }
  [[nodiscard]] const ChildPlanes<width>& decoded_planes() const { return planes; }
  [[nodiscard]] NodeRef child(std::size_t i) const { return {first[i], counts[i]}; }
};
static_assert(sizeof(WideFloatNode<4>) == 128 && sizeof(WideFloatNode<8>) == 256);

}  // namespace hitpipe::ref
