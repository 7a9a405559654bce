// A hierarchy of wide nodes, collapsed from a binary one: from a branch's two children on, the branch with
// the largest surface is replaced by its own two, until the node is full or has only leaves. (CWBVH's
// authors choose by dynamic programming, and merge leaves; here leaves stay as they are, so that formats are
// compared on the same leaves.)
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rays/tree/bvh.hpp"
#include "rays/tree/near_first_store.hpp"
#include "rays/tree/wide_node.hpp"

namespace hitpipe::ref {

/// Stored: a WideNode or a WideFloatNode.
template <class Stored>
class WideNodes {
 public:
  static constexpr std::size_t width = Stored::width;
  static constexpr std::size_t bytes_per_node = sizeof(Stored);

  /// `bvh` needs at least one node; its data is copied. Leaves with more than `most_in_leaf` triangles are
  /// halved; an encoding with 8-bit planes has at most most_in_wide_leaf. Throws std::invalid_argument, one
  /// line, when a box leaves its parent's.
  explicit WideNodes(const Bvh& bvh, int most_in_leaf = most_in_wide_leaf);

  [[nodiscard]] BoxedChild root() const { return {}; }
  [[nodiscard]] unsigned children(const BoxedChild& node, std::array<BoxedChild, width>& children) const {
    const Stored& stored = nodes_[node.first];
    const ChildPlanes<Stored::width>& planes = stored.decoded_planes();
    for (std::size_t i = 0; i < stored.children(); ++i) {
      const NodeRef child = stored.child(i);
      children[i] = {{{planes[0][i], planes[1][i], planes[2][i]}, {planes[3][i], planes[4][i], planes[5][i]}},
                     child.count,
                     child.first};
    }
    return stored.children();
  }
  [[nodiscard]] const Stored& node(std::uint32_t number) const { return nodes_[number]; }
  /// Triangles of a node's leaves are neighbours, so the order differs from that of the binary hierarchy.
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  [[nodiscard]] std::span<const std::uint32_t> triangles_before() const { return {}; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  std::vector<Stored> nodes_;
  std::vector<std::uint32_t> order_;
};

extern template class WideNodes<WideNode<4>>;
extern template class WideNodes<WideNode<8>>;
extern template class WideNodes<WideFloatNode<4>>;
extern template class WideNodes<WideFloatNode<8>>;

}  // namespace hitpipe::ref
