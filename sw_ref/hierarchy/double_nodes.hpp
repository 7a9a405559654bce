// Nodes in binary64 (section 5.7): 56 bytes. The box is an exact copy of the padded binary32 box, so what
// holds for plain nodes holds here. A NodeStore (sw_ref/hierarchy/node_store.hpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "rays/mesh/aabb.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

/// The same box in binary64.
[[nodiscard]] inline BasicAabb<double> widened(const Aabb& box) {
  return {glm::dvec3(box.min), glm::dvec3(box.max)};
}

struct DoubleNode {
  BasicAabb<double> box;
  std::int32_t count;   ///< as BvhNode::count
  std::uint32_t first;  ///< as BvhNode::first
};
static_assert(sizeof(DoubleNode) == 56, "six binary64 coordinates, count and pointer of 4 bytes each");

class DoubleNodes {
 public:
  using Box = BasicAabb<double>;
  using Node = std::uint32_t;  ///< index as in Bvh::nodes
  static constexpr std::size_t bytes_per_node = sizeof(DoubleNode);

  /// `bvh` needs at least one node; its data is copied.
  explicit DoubleNodes(const Bvh& bvh);

  [[nodiscard]] Node root() const { return 0; }
  [[nodiscard]] Node child(Node node, unsigned which) const { return nodes_[node].first + which; }
  [[nodiscard]] const Box& box(Node node) const { return nodes_[node].box; }
  [[nodiscard]] std::int32_t count(Node node) const { return nodes_[node].count; }
  [[nodiscard]] std::uint32_t first(Node node) const { return nodes_[node].first; }
  [[nodiscard]] std::uint32_t index(Node node) const { return node; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  std::vector<DoubleNode> nodes_;
};

}  // namespace hitpipe::ref
