#include "sw_ref/hierarchy/hierarchical_nodes.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "sw_ref/hierarchy/node_store.hpp"

namespace hitpipe::ref {
namespace {

/// Codes of one axis whose decoded coordinates contain [min, max]. Such codes exist: decoding is monotone in
/// the code, code 0 decodes to the frame's origin, and the top code to at least its far end. The first guess
/// is at most a few codes off.
template <int bits>
class AxisCodes {
 public:
  AxisCodes(const RelativeFrame<bits>& frame, int axis) : frame_(frame), axis_(axis) {}

  /// The largest decoded coordinate <= min.
  [[nodiscard]] std::uint32_t below(float min) const {
    std::uint32_t code = guess(min);
    while (code > 0 && decoded(code) > min) --code;
    while (code < top_code<bits> && decoded(code) < min && decoded(code + 1) <= min) ++code;
    return code;
  }
  /// The least decoded coordinate >= max.
  [[nodiscard]] std::uint32_t above(float max) const {
    std::uint32_t code = guess(max);
    while (code < top_code<bits> && decoded(code) < max) ++code;
    while (code > 0 && decoded(code) > max && decoded(code - 1) >= max) --code;
    return code;
  }

 private:
  [[nodiscard]] float decoded(std::uint32_t code) const {
    return frame_.decoded(axis_, static_cast<float>(code));
  }
  [[nodiscard]] std::uint32_t guess(float x) const {
    const double code = (static_cast<double>(x) - frame_.origin(axis_)) / frame_.step(axis_);
    return static_cast<std::uint32_t>(std::clamp(code, 0.0, static_cast<double>(top_code<bits>)));
  }

  const RelativeFrame<bits>& frame_;
  int axis_;
};

/// False also for NaN.
bool contains(const Aabb& outer, const Aabb& inner) {
  for (int axis = 0; axis < 3; ++axis) {
    if (!(outer.min[axis] <= inner.min[axis] && inner.min[axis] <= inner.max[axis] &&
          inner.max[axis] <= outer.max[axis])) {
      return false;
    }
  }
  return true;
}

template <int bits>
std::array<std::byte, 3 * HierarchicalNode<bits>::axis_bytes> encoded(const Aabb& box, const Aabb& parent) {
  const RelativeFrame<bits> frame(parent);
  std::array<std::byte, 3 * HierarchicalNode<bits>::axis_bytes> bytes{};
  for (int axis = 0; axis < 3; ++axis) {
    const AxisCodes<bits> codes(frame, axis);
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
    if (!contains(parent.box, plain.box)) {
      throw std::invalid_argument(
          index == 0
              ? fmt::format("{}-bit nodes: the root's box leaves the cube of +-{}", bits, hierarchical_frame)
              : fmt::format("{}-bit nodes: the box of node {} leaves its parent's", bits, index));
    }
    nodes_[index] = {encoded<bits>(plain.box, parent.box), static_cast<Count>(plain.count), plain.first};
    const Node node = decoded(parent, index);
    if (!contains(node.box, plain.box)) {
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
