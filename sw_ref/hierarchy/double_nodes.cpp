#include "sw_ref/hierarchy/double_nodes.hpp"

#include "sw_ref/hierarchy/node_store.hpp"

namespace hitpipe::ref {

static_assert(NodeStore<DoubleNodes>);

DoubleNodes::DoubleNodes(const Bvh& bvh) {
  nodes_.reserve(bvh.nodes.size());
  for (const BvhNode& node : bvh.nodes) nodes_.push_back({widened(node.box), node.count, node.first});
}

}  // namespace hitpipe::ref
