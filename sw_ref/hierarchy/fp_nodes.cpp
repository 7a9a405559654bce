#include "sw_ref/hierarchy/fp_nodes.hpp"

#include "sw_ref/hierarchy/node_store.hpp"
#include "sw_ref/quantise/fp_box.hpp"

namespace hitpipe::ref {

static_assert(NodeStore<FpNodes>);

FpNodes::FpNodes(const Bvh& bvh, const hls::FpBits& bits)
    : bytes_per_node(node_bytes(bits)), nodes_(bvh.nodes) {
  for (BvhNode& node : nodes_) node.box = round_box(node.box, bits);
}

std::size_t FpNodes::node_bytes(const hls::FpBits& bits) {
  return (6 * static_cast<std::size_t>(bits.width()) + 7) / 8 + sizeof(BvhNode::count) +
         sizeof(BvhNode::first);
}

}  // namespace hitpipe::ref
