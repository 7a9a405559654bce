#include "sw_ref/hierarchy/int_nodes.hpp"

#include "sw_ref/hierarchy/node_store.hpp"

namespace hitpipe::ref {

static_assert(NodeStore<IntNodes>);

IntNodes::IntNodes(const Bvh& bvh, int coord_bits, const CoarseAxes& coarse, int finer)
    : bytes_per_node(node_bytes(coord_bits, coarse)), coord_bits_(coord_bits) {
  // This also checks coord_bits before memory is allocated for it.
  (void)quantise_box({glm::vec3(0), glm::vec3(0)}, coord_bits);
  check_coarse(coarse, coord_bits, "IntNodes");
  int bit = 0;
  for (std::size_t i = 0; i < 6; ++i) {
    const int dropped = coarse.dropped[i % 3];
    const int bits = coord_bits - dropped;
    places_[i] = {static_cast<std::uint32_t>(bit / 8), 64 - bits - bit % 8,
                  -static_cast<std::int32_t>(1U << dropped)};
    bit += bits;
  }
  bytes_.resize(bytes_per_node * bvh.nodes.size());
  std::byte* at = bytes_.data();
  for (const BvhNode& node : bvh.nodes) {
    write(at, coarse_box(quantise_box(node.box, coord_bits, finer), coarse, coord_bits));
    at += bytes_per_node;
    std::memcpy(at - tail_bytes, &node.count, sizeof node.count);
    std::memcpy(at - sizeof node.first, &node.first, sizeof node.first);
  }
}

std::size_t IntNodes::node_bytes(int coord_bits, const CoarseAxes& coarse) {
  int bits = 6 * coord_bits;
  for (const int dropped : coarse.dropped) bits -= 2 * dropped;
  return (static_cast<std::size_t>(bits) + 7) / 8 + tail_bytes;
}

/// The bytes must be zero.
void IntNodes::write(std::byte* node, const IntBox& box) const {
  for (std::size_t i = 0; i < 6; ++i) {
    const auto value = static_cast<std::uint64_t>(i < 3 ? box.min[i] : box.max[i - 3]);
    std::byte* const at = node + places_[i].byte;
    const std::uint64_t field = value << (64 - coord_bits_) >> places_[i].above;
    const std::uint64_t word = read<std::uint64_t>(at) | field;
    std::memcpy(at, &word, sizeof word);
  }
}

}  // namespace hitpipe::ref
