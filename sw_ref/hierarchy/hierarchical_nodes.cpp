#include "sw_ref/hierarchy/hierarchical_nodes.hpp"

#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/tree/axis_codes.hpp"
#include "sw_ref/hierarchy/node_store.hpp"

namespace hitpipe::ref {
namespace {

template <int bits>
std::array<std::byte, 3 * HierarchicalNode<bits>::axis_bytes> encoded(const Aabb& box, const Aabb& parent) {
  const RelativeFrame<bits> frame(parent);
  std::array<std::byte, 3 * HierarchicalNode<bits>::axis_bytes> bytes{};
  for (int axis = 0; axis < 3; ++axis) {
    const AxisCodes codes(frame, axis);
    const std::uint32_t word = codes.below(box.min[axis]) | codes.above(box.max[axis]) << bits;
    constexpr std::size_t size = HierarchicalNode<bits>::axis_bytes;
    std::memcpy(bytes.data() + static_cast<std::size_t>(axis) * size, &word, size);
  }
  return bytes;
}

}  // namespace

template <int bits, bool lut>
HierarchicalNodes<bits, lut>::HierarchicalNodes(const Bvh& bvh) : nodes_(bvh.nodes.size()) {
  using Count = typename Stored::Count;
  const auto encode = [&](std::uint32_t index, const Node& parent) {
    const BvhNode& plain = bvh.nodes[index];
    if (plain.count > std::numeric_limits<Count>::max()) {
      throw std::invalid_argument(
          fmt::format("{}-bit nodes: a leaf of {} triangles; at most {} fit, build with fewer per leaf", bits,
                      plain.count, std::numeric_limits<Count>::max()));
    }
    if (!encloses(parent.box, plain.box)) {
      throw std::invalid_argument(
          index == 0
              ? fmt::format("{}-bit nodes: the root's box leaves the cube of +-{}", bits, hierarchical_frame)
              : fmt::format("{}-bit nodes: the box of node {} leaves its parent's", bits, index));
    }
    nodes_[index] = {encoded<bits>(plain.box, parent.box), static_cast<Count>(plain.count), plain.first};
    const Node node = decoded(parent, index);
    if (!encloses(node.box, plain.box)) {
      throw std::logic_error(
          fmt::format("{}-bit nodes: the decoded box of node {} is too small", bits, index));
    }
    return node;
  };
  std::vector<Node> pending{encode(0, frame_of_root())};
  while (!pending.empty()) {
    const Node node = pending.back();
    pending.pop_back();
    if (count(node) > 0) continue;
    for (unsigned which = 0; which < 2; ++which) pending.push_back(encode(first(node) + which, node));
  }
}

template class HierarchicalNodes<4, false>;
template class HierarchicalNodes<4, true>;
template class HierarchicalNodes<8, false>;
template class HierarchicalNodes<8, true>;
template class HierarchicalNodes<12, false>;
template class HierarchicalNodes<16, false>;

static_assert(NodeStore<HierarchicalNodes<4, true>> && NodeStore<HierarchicalNodes<8>> &&
              NodeStore<HierarchicalNodes<12>> && NodeStore<HierarchicalNodes<16>>);

}  // namespace hitpipe::ref
