// Nodes whose boxes are stored in a few bits relative to the parent's decoded box (sections 5.2 to 5.4): 8
// bytes a node with 4 bits, 12 with 8, 16 with 12, 20 with 16. This is a NodeStore
// (sw_ref/hierarchy/node_store.hpp). A node carries its decoded box, and its children are decoded from it.
// Each decoded box contains the plain one; encoding checks that for every node. With `lut` a table turns
// codes into floats (section 5.4). The parent of the root is the cube of hierarchical_frame. No decoded
// coordinate is beyond +-(1 + 2^-13).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <vector>

#include "rays/mesh/aabb.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/tree/relative_box.hpp"

namespace hitpipe::ref {

/// The root is encoded in a cube that reaches to +-(1 + 2^-20). So the boxes of a scene in [-1, 1] stay
/// inside it when they are padded by 5e-7 (section 4.3).
inline constexpr float hierarchical_frame = 1.0F + 0x1p-20F;

/// The count has the bits that the codes leave free in whole words (section 5.2).
template <int bits>
struct HierarchicalCount;
template <>
struct HierarchicalCount<4> {
  using type = std::int8_t;
};
template <>
struct HierarchicalCount<8> {
  using type = std::int16_t;
};
template <>
struct HierarchicalCount<12> {
  using type = std::int16_t;
};
template <>
struct HierarchicalCount<16> {
  using type = std::int32_t;
};

template <int bits>
struct HierarchicalNode {
  static constexpr std::size_t axis_bytes = bits / 4;  ///< the codes of min and max
  using Count = typename HierarchicalCount<bits>::type;

  std::array<std::byte, 3 * axis_bytes> codes;  ///< x, y, z; min in the lower half of an axis, max above it
  Count count;                                  ///< as BvhNode::count
  std::uint32_t first;                          ///< as BvhNode::first
};
static_assert(sizeof(HierarchicalNode<4>) == 8 && sizeof(HierarchicalNode<8>) == 12, "Table 5.1");
static_assert(sizeof(HierarchicalNode<12>) == 16 && sizeof(HierarchicalNode<16>) == 20);

template <int bits, bool lut = false>
class HierarchicalNodes {
  static_assert(!lut || bits == 4 || bits == 8, "tables of 256 entries");
  static_assert(std::endian::native == std::endian::little, "codes are read as words of memory");

 public:
  /// Two vector registers, written and read as such. A processor stalls when it reads a vector that was
  /// written in pieces.
  struct alignas(16) Node {
    Aabb box;
    std::uint32_t index;  ///< as in Bvh::nodes
    std::uint32_t unused;
  };
  using Box = Aabb;
  using Stored = HierarchicalNode<bits>;
  static constexpr std::size_t bytes_per_node = sizeof(Stored);

  /// `bvh` needs at least one node; its data is copied. Throws std::invalid_argument, one line, when a leaf
  /// has more triangles than the count holds, when the root leaves the cube of hierarchical_frame, or when a
  /// box leaves its parent's.
  explicit HierarchicalNodes(const Bvh& bvh);

  [[nodiscard]] Node root() const { return decoded(frame_of_root(), 0); }
  [[nodiscard]] Node child(const Node& node, unsigned which) const {
    return decoded(node, first(node) + which);
  }
  [[nodiscard]] const Box& box(const Node& node) const { return node.box; }
  [[nodiscard]] std::int32_t count(const Node& node) const { return nodes_[node.index].count; }
  [[nodiscard]] std::uint32_t first(const Node& node) const { return nodes_[node.index].first; }
  [[nodiscard]] std::uint32_t index(const Node& node) const { return node.index; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  static Node frame_of_root() {
    return {{glm::vec3(-hierarchical_frame), glm::vec3(hierarchical_frame)}, 0, 0};
  }

  /// As RelativeFrame::decoded(), the six coordinates in lanes: x, y, z of min and x of max, then the rest.
  [[nodiscard]] Node decoded(const Node& parent, std::uint32_t index) const {
    struct Lanes {
      Four low, high;
    };
    static_assert(sizeof(Lanes) == sizeof(Node));
    const auto from = std::bit_cast<Lanes>(parent);
    const Four origin = __builtin_shufflevector(from.low, from.low, 0, 1, 2, 0);
    const Four width = __builtin_shufflevector(from.low, from.high, 3, 4, 5, 3) - origin;
    constexpr float least = std::numeric_limits<float>::min();
    constexpr float share = step_share<bits>;
    const Four step =
        sum_of_product(Four{least, least, least, least}, width, Four{share, share, share, share});

    const std::uint32_t x = codes_of(index, 0);
    const std::uint32_t y = codes_of(index, 1);
    const std::uint32_t z = codes_of(index, 2);
    const Four low_codes{code_value<bits, lut, false>(x), code_value<bits, lut, false>(y),
                         code_value<bits, lut, false>(z), code_value<bits, lut, true>(x)};
    const Four high_codes{code_value<bits, lut, true>(y), code_value<bits, lut, true>(z), 0, 0};
    const Four low = sum_of_product(origin, step, low_codes);
    const Four high = sum_of_product(__builtin_shufflevector(origin, origin, 1, 2, 0, 0),
                                     __builtin_shufflevector(step, step, 1, 2, 0, 0), high_codes);
    const FourWords name{static_cast<std::int32_t>(index), 0, 0, 0};
    const FourWords tail = __builtin_shufflevector(reinterpret_cast<FourWords>(high), name, 0, 1, 4, 5);
    return std::bit_cast<Node>(Lanes{low, reinterpret_cast<Four>(tail)});
  }

  /// The codes of one axis have at most four bytes. Four bytes can be read from their start without leaving
  /// the node.
  [[nodiscard]] std::uint32_t codes_of(std::uint32_t index, std::size_t axis) const {
    const auto* const stored = reinterpret_cast<const std::byte*>(&nodes_[index]);
    std::uint32_t codes;
    std::memcpy(&codes, stored + axis * Stored::axis_bytes, sizeof codes);
    return codes;
  }

  std::vector<Stored> nodes_;
};

extern template class HierarchicalNodes<4, false>;
extern template class HierarchicalNodes<4, true>;
extern template class HierarchicalNodes<8, false>;
extern template class HierarchicalNodes<8, true>;
extern template class HierarchicalNodes<12, false>;
extern template class HierarchicalNodes<16, false>;

}  // namespace hitpipe::ref
