#include "rays/world/pair_nodes.hpp"

#include <algorithm>

namespace hitpipe::ref {

namespace {

/// The boxes of all nodes; a branch has the union of its children. Children follow their parent, so going
/// backwards meets them first.
std::vector<IntBox> refitted(const Bvh& bvh, int coord_bits, int finer) {
  std::vector<IntBox> boxes(bvh.nodes.size());
  for (std::size_t i = boxes.size(); i-- > 0;) {
    const BvhNode& node = bvh.nodes[i];
    boxes[i] = node.is_leaf() ? quantise_box(node.box, coord_bits, finer)
                              : union_of(boxes[node.first], boxes[node.first + 1]);
  }
  return boxes;
}

/// Bits of a record that start anywhere. They never leave it, because 16 bytes follow the planes.
std::uint64_t word_at(const std::byte* record, int bit) {
  std::uint64_t word = 0;
  std::memcpy(&word, record + bit / 8, sizeof word);
  return word >> (bit % 8);
}

}  // namespace

PairBoxes pair_boxes(const IntBox& first, const IntBox& second) {
  PairBoxes pair;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool low_is_second = second.min[axis] > first.min[axis];
    const bool high_is_second = second.max[axis] < first.max[axis];
    pair.planes.min[axis] = std::max(first.min[axis], second.min[axis]);
    pair.planes.max[axis] = std::min(first.max[axis], second.max[axis]);
    pair.owners = static_cast<std::uint8_t>(pair.owners | (low_is_second ? 1U : 0U) << axis |
                                            (high_is_second ? 1U : 0U) << (axis + 3));
  }
  return pair;
}

PairNodes::PairNodes(const Bvh& bvh, int coord_bits, int finer)
    : bytes_per_record(record_bytes(coord_bits)), coord_bits_(coord_bits) {
  const std::vector<IntBox> boxes = refitted(bvh, coord_bits, finer);
  // The records of branches follow the root's in the order of their nodes.
  std::vector<std::uint32_t> record_of(bvh.nodes.size());
  std::uint32_t records = 1;
  for (std::size_t i = 0; i < bvh.nodes.size(); ++i)
    if (!bvh.nodes[i].is_leaf()) record_of[i] = records++;
  const auto child = [&](std::size_t node) {
    const BvhNode& n = bvh.nodes[node];
    return n.is_leaf() ? PairChild{n.count, n.first} : PairChild{PairChild::branch, record_of[node]};
  };

  bytes_.reserve(bytes_per_record * records);
  first_nodes_.reserve(records);
  append({boxes[0], 0}, 0, {child(0), PairChild{}}, 0);
  for (const BvhNode& node : bvh.nodes) {
    if (node.is_leaf()) continue;
    append(pair_boxes(boxes[node.first], boxes[node.first + 1]), node.split_axis(),
           {child(node.first), child(node.first + 1)}, node.first);
  }
}

PairBoxes PairNodes::boxes(std::uint32_t record) const {
  const std::byte* const at = address(record);
  PairBoxes pair;
  for (std::size_t i = 0; i < 6; ++i) {
    const auto word =
        static_cast<std::int64_t>(word_at(at, static_cast<int>(i) * coord_bits_) << (64 - coord_bits_));
    const auto plane = static_cast<std::int32_t>(word >> (64 - coord_bits_));
    (i < 3 ? pair.planes.min[i] : pair.planes.max[i - 3]) = plane;
  }
  pair.owners = static_cast<std::uint8_t>(word_at(at, 6 * coord_bits_) & 0x3FU);
  return pair;
}

int PairNodes::split_axis(std::uint32_t record) const {
  return static_cast<int>(word_at(address(record), 6 * coord_bits_ + 6) & 3U);
}

void PairNodes::append(const PairBoxes& boxes, int split_axis, const std::array<PairChild, 2>& children,
                       std::uint32_t first_node) {
  bytes_.resize(bytes_.size() + bytes_per_record);
  std::byte* const record = bytes_.data() + bytes_.size() - bytes_per_record;
  const auto put = [&](int bit, std::uint64_t value) {
    std::uint64_t word = 0;
    std::memcpy(&word, record + bit / 8, sizeof word);
    word |= value << (bit % 8);
    std::memcpy(record + bit / 8, &word, sizeof word);
  };
  const std::uint64_t ones = ~std::uint64_t{0} >> (64 - coord_bits_);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::int32_t plane = i < 3 ? boxes.planes.min[i] : boxes.planes.max[i - 3];
    put(static_cast<int>(i) * coord_bits_, static_cast<std::uint64_t>(plane) & ones);
  }
  put(6 * coord_bits_, boxes.owners);
  put(6 * coord_bits_ + 6, static_cast<std::uint64_t>(split_axis));
  std::memcpy(record + bytes_per_record - sizeof children, children.data(), sizeof children);
  first_nodes_.push_back(first_node);
}

}  // namespace hitpipe::ref
