// How a builder splits the triangles of one node.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "sw_ref/hierarchy/items.hpp"
#include "sw_ref/scene/aabb.hpp"

namespace hitpipe::ref {

/// A node with at least two triangles, and at least one axis along which it may be split.
struct Splittable {
  std::span<Item> items;
  Aabb bounds;        ///< of the items
  int axis;           ///< the axis whose turn it is
  float least_width;  ///< an axis is not split if the bounds are narrower along it

  [[nodiscard]] bool is_narrow(int along) const {
    return bounds.max[along] - bounds.min[along] < least_width;
  }
};

struct Split {
  std::size_t middle;  ///< number of items of child 0, which are now in front; no child is empty
  int axis;
};

/// Section 4.3: splits at the middle of the box, starting with the axis whose turn it is. If every axis
/// leaves a child empty, it halves the list.
[[nodiscard]] Split split_at_middle(const Splittable& node);

/// Wald (2007): splits at the cheapest boundary of up to 32 bins along each axis. Returns nothing if a leaf
/// is as cheap and `max_triangles` allows it.
[[nodiscard]] std::optional<Split> split_by_cost(const Splittable& node, int max_triangles);

}  // namespace hitpipe::ref
