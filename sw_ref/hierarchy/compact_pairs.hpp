// Records of two children in 12, 16 or 20 bytes: the six planes that the two boxes do not share with their
// common box, as in PairNodes, but in few bits relative to that box, as in HierarchicalNodes.
//
// The bits of a record:
//   6 planes of p bits     relative to the parent's decoded box, steps of 1 / (2^p - 1) of its side
//   6 owner bits           which child has the plane; the other has the parent's
//   split axis of 2 bits    for the order by direction
//   2 counts of 4 bits     0: no child, 1 to 14: triangles of a leaf, 15: a branch
//   1 pointer of 32 bits   in words of 4 bytes, to what child 0 has; what child 1 has lies behind it
//   48 + 6p bits: 96 at p = 8, 126 of 128 at 13, 156 of 160 at 18
// So records and triangles lie in one array, as in the core's image (rays/image/core_image.hpp). Records
// that a ray reads one after the other lie in one line of a cache where they can.
//
// The parent's box is the anchor. The traversal has it, because it has decoded it; so each entry of a stack
// holds a box, 24 bytes, beside the pointer and count. The root's box is known outside the records.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "rays/tree/bvh.hpp"
#include "rays/tree/near_first_store.hpp"
#include "rays/tree/relative_box.hpp"

namespace hitpipe::ref {

/// A record, not packed. Its pointer stands as the numbers of the record and triangle that lie there.
struct CompactPair {
  static constexpr int most_in_leaf = 14;

  std::array<std::uint32_t, 6> planes{};  ///< codes of min x, y, z, then of max
  std::uint8_t owners = 0;                ///< bit i: plane i is child 1's, else child 0's
  std::uint8_t children = 0;
  std::uint8_t axis = 0;                 ///< along which the branch was split
  std::array<std::int16_t, 2> counts{};  ///< as BoxedChild::count
  std::uint32_t record = 0;
  std::uint32_t triangle = 0;
};

template <int bits>
class CompactPairs {
 public:
  static constexpr std::size_t width = 2;
  static constexpr std::size_t bytes_per_node = std::size_t{48 + 6 * bits + 31} / 32 * 4;

  /// `bvh` needs at least one node; its data is copied. Leaves with more triangles than a record counts are
  /// halved. Throws std::invalid_argument, one line, when a box leaves its parent's.
  explicit CompactPairs(const Bvh& bvh);

  [[nodiscard]] BoxedChild root() const { return {root_, BoxedChild::branch, 0}; }
  [[nodiscard]] unsigned children(const BoxedChild& node, std::array<BoxedChild, width>& children) const {
    const CompactPair& pair = records_[node.first];
    const RelativeFrame<bits> frame(node.box);
    children[0] = children[1] = {node.box, pair.counts[0], pair.record};
    for (unsigned axis = 0; axis < 3; ++axis) {
      const auto coordinate = [&](unsigned plane) {
        return frame.decoded(static_cast<int>(axis), static_cast<float>(pair.planes[plane]));
      };
      children[pair.owners >> axis & 1U].box.min[static_cast<int>(axis)] = coordinate(axis);
      children[pair.owners >> (axis + 3) & 1U].box.max[static_cast<int>(axis)] = coordinate(axis + 3);
    }
    children[1].count = pair.counts[1];
    if (!children[0].is_branch()) children[0].first = pair.triangle;
    children[1].first = children[1].is_branch() ? pair.record + (children[0].is_branch() ? 1 : 0)
                                                : pair.triangle + static_cast<std::uint32_t>(pair.counts[0]);
    return pair.children;
  }
  [[nodiscard]] int split_axis(const BoxedChild& node) const { return records_[node.first].axis; }
  [[nodiscard]] std::span<const std::uint32_t> order() const { return order_; }
  [[nodiscard]] std::span<const std::uint32_t> triangles_before() const { return triangles_before_; }
  [[nodiscard]] std::size_t size() const { return records_.size(); }

 private:
  Aabb root_;
  std::vector<CompactPair> records_;
  std::vector<std::uint32_t> order_;
  std::vector<std::uint32_t> triangles_before_;  ///< by record
};

extern template class CompactPairs<8>;
extern template class CompactPairs<13>;
extern template class CompactPairs<18>;

}  // namespace hitpipe::ref
