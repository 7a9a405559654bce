#include "sw_ref/hierarchy/compact_pairs.hpp"

#include <algorithm>
#include <stdexcept>

#include <fmt/format.h>

#include "rays/tree/axis_codes.hpp"
#include "rays/tree/small_leaves.hpp"

namespace hitpipe::ref {
namespace {

constexpr std::size_t triangle_bytes = 36;  // three corners in binary32
constexpr std::size_t line_bytes = 64;

/// A plane belongs to the child that lies farther inside the parent's decoded box. The box of the other grows
/// by what it lies inside itself.
template <int bits>
void encode_planes(CompactPair& pair, const Aabb& parent, std::span<const Aabb> boxes) {
  const RelativeFrame<bits> frame(parent);
  const Aabb& second = boxes.back();
  for (int axis = 0; axis < 3; ++axis) {
    const AxisCodes codes(frame, axis);
    const auto low = static_cast<unsigned>(axis);
    const bool second_min = second.min[axis] > boxes[0].min[axis];
    const bool second_max = second.max[axis] < boxes[0].max[axis];
    pair.planes[low] = codes.below(boxes[second_min ? 1 : 0].min[axis]);
    pair.planes[low + 3] = codes.above(boxes[second_max ? 1 : 0].max[axis]);
    pair.owners = static_cast<std::uint8_t>(pair.owners | (second_min ? 1U : 0U) << low |
                                            (second_max ? 1U : 0U) << (low + 3));
  }
}

}  // namespace

template <int bits>
CompactPairs<bits>::CompactPairs(const Bvh& bvh) : root_(bvh.nodes.front().box) {
  const Bvh binary = small_leaves(bvh, CompactPair::most_in_leaf);
  struct Pending {
    std::uint32_t node;  ///< of the binary hierarchy
    BoxedChild record;   ///< with the decoded box
  };
  const auto add_record = [&] {
    triangles_before_.push_back(static_cast<std::uint32_t>(order_.size()));
    records_.emplace_back();
    return static_cast<std::uint32_t>(records_.size() - 1);
  };
  const auto written = [&] { return records_.size() * bytes_per_node + order_.size() * triangle_bytes; };
  const auto less_likely = [](const Pending& a, const Pending& b) {
    return half_area(a.record.box) < half_area(b.record.box);
  };
  std::vector<Pending> pending{{0, {root_, BoxedChild::branch, add_record()}}};
  // What a ray that comes here reads next is to lie in the same line of a cache: the children of the largest
  // box are written next, until a line is full. Then another line begins with the children of the last box.
  std::size_t in_line = 0;  // pending from here on began in this line
  std::size_t line = 0;
  while (!pending.empty()) {
    if (in_line == pending.size() || written() - line >= line_bytes) {
      in_line = pending.size() - 1;
      line = written();
    }
    const auto next =
        std::max_element(pending.begin() + static_cast<std::ptrdiff_t>(in_line), pending.end(), less_likely);
    const Pending at = *next;
    pending.erase(next);
    const BvhNode& node = binary.nodes[at.node];
    // A root that is a leaf is the only child of its record.
    const std::uint32_t first = node.is_leaf() ? at.node : node.first;
    CompactPair pair{.record = static_cast<std::uint32_t>(records_.size()),
                     .triangle = static_cast<std::uint32_t>(order_.size())};
    pair.children = node.is_leaf() ? 1 : 2;
    pair.axis = static_cast<std::uint8_t>(node.is_leaf() ? 0 : node.split_axis());
    std::array<Aabb, 2> boxes;
    for (unsigned i = 0; i < pair.children; ++i) {
      const BvhNode& child = binary.nodes[first + i];
      boxes[i] = child.box;
      if (!encloses(at.record.box, child.box))
        throw std::invalid_argument(
            fmt::format("compact pairs: the box of node {} leaves its parent's", first + i));
      if (!child.is_leaf()) {
        add_record();
        continue;
      }
      pair.counts[i] = static_cast<std::int16_t>(child.count);
      const auto triangles = binary.order.begin() + child.first;
      order_.insert(order_.end(), triangles, triangles + child.count);
    }
    encode_planes<bits>(pair, at.record.box, std::span(boxes).first(pair.children));
    records_[at.record.first] = pair;
    std::array<BoxedChild, width> decoded;
    for (unsigned i = children(at.record, decoded); i-- > 0;) {
      if (!encloses(decoded[i].box, boxes[i]))
        throw std::logic_error(
            fmt::format("compact pairs: a decoded box in record {} is too small", at.record.first));
      if (decoded[i].is_branch()) pending.push_back({first + i, decoded[i]});
    }
  }
}

template class CompactPairs<8>;
template class CompactPairs<13>;
template class CompactPairs<18>;

static_assert(NearFirstStore<CompactPairs<18>> && CompactPairs<8>::bytes_per_node == 12 &&
              CompactPairs<13>::bytes_per_node == 16 && CompactPairs<18>::bytes_per_node == 20);

}  // namespace hitpipe::ref
