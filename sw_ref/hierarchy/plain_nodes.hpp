// The hierarchy itself as a store of nodes: 32 bytes each, no copy (Table 5.1).
#pragma once

#include <cstddef>
#include <cstdint>

#include "rays/tree/bvh.hpp"
#include "sw_ref/hierarchy/node_store.hpp"

namespace hitpipe::ref {

/// The hierarchy must outlive it unchanged and has at least one node.
class PlainNodes {
 public:
  using Box = Aabb;
  using Node = const BvhNode*;
  static constexpr std::size_t bytes_per_node = sizeof(BvhNode);

  explicit PlainNodes(const Bvh& bvh) : nodes_(bvh.nodes.data()), size_(bvh.nodes.size()) {}

  [[nodiscard]] Node root() const { return nodes_; }
  [[nodiscard]] Node child(const Node& node, unsigned which) const { return nodes_ + (node->first + which); }
  [[nodiscard]] const Aabb& box(const Node& node) const { return node->box; }
  [[nodiscard]] std::int32_t count(const Node& node) const { return node->count; }
  [[nodiscard]] std::uint32_t first(const Node& node) const { return node->first; }
  [[nodiscard]] std::uint32_t index(const Node& node) const {
    return static_cast<std::uint32_t>(node - nodes_);
  }
  [[nodiscard]] std::size_t size() const { return size_; }

 private:
  const BvhNode* nodes_;
  std::size_t size_;
};
static_assert(NodeStore<PlainNodes>);

}  // namespace hitpipe::ref
