// Nodes of a float hierarchy in any format eEmM: six planes of 1 + E + M bits without a gap, as IntNodes has
// its coordinates, then count and pointer of 4 bytes each. That is 32 bytes with binary32, 26 with e8m15 and
// 20 with e8m7. Planes are kept as binary32, ready for the box test; bytes_per_node is the packed size.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "hls/box/fp_format.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

class FpNodes {
 public:
  using Box = Aabb;
  using Node = std::uint32_t;  ///< index as in Bvh::nodes
  const std::size_t bytes_per_node;
  [[nodiscard]] static std::size_t node_bytes(const hls::FpBits& bits);

  /// `bvh` needs at least one node; its data is copied. Throws as round_box() does.
  FpNodes(const Bvh& bvh, const hls::FpBits& bits);

  [[nodiscard]] Node root() const { return 0; }
  [[nodiscard]] Node child(Node node, unsigned which) const { return first(node) + which; }
  [[nodiscard]] const Box& box(Node node) const { return nodes_[node].box; }
  [[nodiscard]] std::int32_t count(Node node) const { return nodes_[node].count; }
  [[nodiscard]] std::uint32_t first(Node node) const { return nodes_[node].first; }
  [[nodiscard]] std::uint32_t index(Node node) const { return node; }
  [[nodiscard]] std::size_t size() const { return nodes_.size(); }

 private:
  std::vector<BvhNode> nodes_;
};

}  // namespace hitpipe::ref
