#include "rays/tree/wide_nodes.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/tree/small_leaves.hpp"

namespace hitpipe::ref {
namespace {

/// The nodes that become the children of one wide node.
std::vector<std::uint32_t> opened(const Bvh& bvh, std::uint32_t node, std::size_t width) {
  std::vector<std::uint32_t> children{node};
  const auto opens_first = [&](std::uint32_t a, std::uint32_t b) {
    const BvhNode& one = bvh.nodes[a];
    const BvhNode& other = bvh.nodes[b];
    if (one.is_leaf() != other.is_leaf()) return other.is_leaf();
    return half_area(one.box) > half_area(other.box);
  };
  while (children.size() < width) {
    const auto largest = std::min_element(children.begin(), children.end(), opens_first);
    const BvhNode& branch = bvh.nodes[*largest];
    if (branch.is_leaf()) break;
    *largest = branch.first;
    children.push_back(branch.first + 1);
  }
  return children;
}

}  // namespace

template <class Stored>
WideNodes<Stored>::WideNodes(const Bvh& bvh, int most_in_leaf) {
  const Bvh binary = small_leaves(bvh, most_in_leaf);
  struct Pending {
    std::uint32_t binary;
    std::uint32_t wide;
  };
  const auto nothing = Stored({{}, {}}, {}, {});
  nodes_.push_back(nothing);
  std::vector<Pending> pending{{0, 0}};
  while (!pending.empty()) {
    const Pending at = pending.back();
    pending.pop_back();
    const WidePointers first{static_cast<std::uint32_t>(nodes_.size()),
                             static_cast<std::uint32_t>(order_.size())};
    std::vector<BoxedChild> children;
    const Aabb& box = binary.nodes[at.binary].box;
    for (const std::uint32_t number : opened(binary, at.binary, width)) {
      const BvhNode& child = binary.nodes[number];
      if (!encloses(box, child.box))
        throw std::invalid_argument(
            fmt::format("wide nodes: the box of node {} leaves its parent's", number));
      children.push_back({child.box, child.is_leaf() ? child.count : BoxedChild::branch, 0});
      if (child.is_leaf()) {
        const auto triangles = binary.order.begin() + child.first;
        order_.insert(order_.end(), triangles, triangles + child.count);
      } else {
        pending.push_back({number, static_cast<std::uint32_t>(nodes_.size())});
        nodes_.push_back(nothing);
      }
    }
    nodes_[at.wide] = Stored(box, children, first);
    std::array<BoxedChild, width> decoded;
    const unsigned count = this->children({{}, BoxedChild::branch, at.wide}, decoded);
    for (unsigned i = 0; i < count; ++i) {
      if (!encloses(decoded[i].box, children[i].box))
        throw std::logic_error(fmt::format("wide nodes: a decoded box in node {} is too small", at.wide));
    }
  }
}

template class WideNodes<WideNode<4>>;
template class WideNodes<WideNode<8>>;
template class WideNodes<WideFloatNode<4>>;
template class WideNodes<WideFloatNode<8>>;

static_assert(NearFirstStore<WideNodes<WideNode<4>>> && NearFirstStore<WideNodes<WideFloatNode<8>>>);

}  // namespace hitpipe::ref
