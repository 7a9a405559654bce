// The triangles of a mesh as a builder sorts them. Boxes are moved together with their indices, so each pass
// over a node reads memory in order. That takes 28 bytes a triangle. Long passes are cut into blocks for
// several threads. The cuts depend only on the number of items, so the results do not depend on the threads.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_reduce.h>

#include "sw_ref/scene/aabb.hpp"
#include "sw_ref/scene/mesh.hpp"

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
  return tbb::parallel_deterministic_reduce(
      tbb::blocked_range<std::size_t>(0, items.size(), item_block), none,
      [&](const auto& block, const Value& value) { return add_all(block.begin(), block.end(), value); },
      [&](Value value, const Value& other) {
        join(value, other);
        return value;
      });
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
  tbb::parallel_for(std::size_t{0}, lows.size(), [&](std::size_t i) {
    lows[i] = partition_block(i * item_block, std::min((i + 1) * item_block, items.size()));
  });
  std::size_t middle = 0;
  for (const std::size_t low : lows) middle += low;
  join_blocks(items, lows, middle);
  return middle;
}

}  // namespace hitpipe::ref
