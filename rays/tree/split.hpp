// How a builder splits the triangles of one node. It moves their boxes together with their indices, so each
// pass over a node reads memory in order. That takes 28 bytes a triangle. Long passes are cut into blocks for
// several threads. The cuts depend only on the number of items, so the results do not depend on the threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "host/parallel.hpp"
#include "rays/mesh/aabb.hpp"
#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

struct Item {
  Aabb box;  ///< of one triangle
  std::uint32_t triangle;

  [[nodiscard]] float centre(int axis) const { return (box.min[axis] + box.max[axis]) * 0.5F; }
};

constexpr std::size_t item_block = 1U << 15U;

/// One item for each triangle, in the mesh's order.
[[nodiscard]] std::vector<Item> make_items(const Mesh& mesh);

/// Adds every item to a Value by add(value, item). join(value, other) combines the values of two blocks.
template <class Value, class Add, class Join>
Value over_items(std::span<const Item> items, const Value& none, const Add& add, const Join& join) {
  const auto add_all = [&](std::size_t first, std::size_t last, Value value) {
    for (std::size_t i = first; i < last; ++i) add(value, items[i]);
    return value;
  };
  if (items.size() <= item_block) return add_all(0, items.size(), none);
  std::vector<Value> values((items.size() + item_block - 1) / item_block);
  host::for_each_block(0, items.size(), item_block, [&](std::size_t first, std::size_t last) {
    values[first / item_block] = add_all(first, last, none);
  });
  for (std::size_t i = 1; i < values.size(); ++i) join(values[0], values[i]);
  return values[0];
}

[[nodiscard]] Aabb bounds_of(std::span<const Item> items);

/// Each block has its low items in front: lows[i] in block i, `middle` in total. Exchanges the items that lie
/// on the wrong side of `middle`.
void join_blocks(std::span<Item> items, const std::vector<std::size_t>& lows, std::size_t middle);

/// Moves the items for which `is_low` holds to the front; returns how many there are.
template <class IsLow>
std::size_t partition(std::span<Item> items, const IsLow& is_low) {
  const auto partition_block = [&](std::size_t first, std::size_t last) {
    std::size_t middle = first;
    for (std::size_t i = first; i < last; ++i) {
      if (is_low(items[i])) std::swap(items[i], items[middle++]);
    }
    return middle - first;
  };
  if (items.size() <= item_block) return partition_block(0, items.size());
  std::vector<std::size_t> lows((items.size() + item_block - 1) / item_block);
  host::for_each_block(0, items.size(), item_block, [&](std::size_t first, std::size_t last) {
    lows[first / item_block] = partition_block(first, last);
  });
  std::size_t middle = 0;
  for (const std::size_t low : lows) middle += low;
  join_blocks(items, lows, middle);
  return middle;
}

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
