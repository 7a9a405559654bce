#include "rays/tree/small_leaves.hpp"

namespace hitpipe::ref {

Bvh small_leaves(const Bvh& bvh, int most) {
  Bvh split = bvh;
  // Halves are appended, so the loop comes to them too.
  for (std::size_t i = 0; i < split.nodes.size(); ++i) {
    const BvhNode leaf = split.nodes[i];
    if (leaf.count <= most) continue;
    const std::int32_t half = leaf.count / 2;
    split.nodes[i] = {leaf.box, -1, static_cast<std::uint32_t>(split.nodes.size())};
    split.nodes.push_back({leaf.box, half, leaf.first});
    split.nodes.push_back({leaf.box, leaf.count - half, leaf.first + static_cast<std::uint32_t>(half)});
  }
  return split;
}

Bvh joined_leaves(const Bvh& bvh, int most) {
  Bvh joined = bvh;
  // Children follow their branch, so they are leaves by then if they can be.
  for (std::size_t i = joined.nodes.size(); i-- > 0;) {
    BvhNode& node = joined.nodes[i];
    if (node.is_leaf()) continue;
    const BvhNode& left = joined.nodes[node.first];
    const BvhNode& right = joined.nodes[node.first + 1];
    if (left.is_leaf() && right.is_leaf() && left.count + right.count <= most &&
        left.first + static_cast<std::uint32_t>(left.count) == right.first) {
      node.count = left.count + right.count;
      node.first = left.first;
    }
  }
  return joined;
}

Bvh below(const Bvh& bvh, std::uint32_t node) {
  Bvh made;
  made.nodes.push_back(bvh.nodes[node]);
  // Children are added behind all that are there, and the loop comes to them.
  for (std::size_t i = 0; i < made.nodes.size(); ++i) {
    const BvhNode its = made.nodes[i];
    const std::uint32_t first = its.first;
    if (its.is_leaf()) {
      made.nodes[i].first = static_cast<std::uint32_t>(made.order.size());
      const auto triangles = bvh.order.begin() + first;
      made.order.insert(made.order.end(), triangles, triangles + its.count);
    } else {
      made.nodes[i].first = static_cast<std::uint32_t>(made.nodes.size());
      made.nodes.push_back(bvh.nodes[first]);
      made.nodes.push_back(bvh.nodes[first + 1]);
    }
  }
  return made;
}

}  // namespace hitpipe::ref
