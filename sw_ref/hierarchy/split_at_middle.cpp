#include "sw_ref/hierarchy/split.hpp"

namespace hitpipe::ref {

Split split_at_middle(const Splittable& node) {
  const glm::vec3 low = node.bounds.min;
  const glm::vec3 extent = node.bounds.max - low;
  for (int tried = 0; tried < 3; ++tried) {
    const int axis = (node.axis + tried) % 3;
    if (node.is_narrow(axis)) continue;
    const float pivot = low[axis] + extent[axis] * 0.5F;
    const std::size_t middle =
        partition(node.items, [=](const Item& item) { return item.centre(axis) < pivot; });
    if (middle != 0 && middle != node.items.size()) return {middle, axis};
  }
  return {node.items.size() / 2, node.axis};
}

}  // namespace hitpipe::ref
