#include "rays/world/int_boxes.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace hitpipe::ref {

namespace {

IntBox empty_box() {
  IntBox box;
  box.min.fill(std::numeric_limits<std::int32_t>::max());
  box.max.fill(std::numeric_limits<std::int32_t>::min());
  return box;
}

void grow(IntBox& box, const IntTriangle::Corner& corner) {
  for (std::size_t i = 0; i < 3; ++i) {
    box.min[i] = std::min(box.min[i], corner[i]);
    box.max[i] = std::max(box.max[i], corner[i]);
  }
}

}  // namespace

std::vector<IntBox> int_boxes(std::span<const IntTriangle> triangles, const Bvh& bvh) {
  std::vector<IntBox> boxes(bvh.nodes.size(), empty_box());
  // Children come after their parents.
  for (std::size_t i = bvh.nodes.size(); i-- > 0;) {
    const BvhNode& node = bvh.nodes[i];
    if (node.is_leaf()) {
      for (std::size_t k = 0; k < static_cast<std::size_t>(node.count); ++k)
        for (const IntTriangle::Corner& corner : triangles[bvh.order[node.first + k]].corners)
          grow(boxes[i], corner);
    } else {
      boxes[i] = union_of(boxes[node.first], boxes[node.first + 1]);
    }
  }
  return boxes;
}

}  // namespace hitpipe::ref
