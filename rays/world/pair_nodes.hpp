// Records of the hierarchy for a unit that tests two boxes at a time (docs/never_misses.md). A record stands for a
// branch. It has six planes on the n-bit grid, one for each face. It belongs to the child that does not reach
// the face of their common box, and six owner bits tell which child that is. Two bits are the axis along
// which the branch was split. Then come count and pointer of both children, 4 bytes each, as in Table 6.1
// (docs/scenes.md has the place of each bit): ceil((6n + 8) / 8) + 16 bytes for two nodes. The first record
// is the root's own box: its child 0 owns all six planes, and there is no child 1.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "rays/tree/bvh.hpp"
#include "rays/world/int_box.hpp"

namespace hitpipe::ref {

struct PairChild {
  static constexpr std::int32_t none = -1;
  static constexpr std::int32_t branch = 0;

  std::int32_t count = none;  ///< >= 1: triangles of a leaf; else `branch` or `none`
  std::uint32_t first = 0;    ///< leaf: first entry of Bvh::order; branch: number of its record
  friend bool operator==(const PairChild&, const PairChild&) = default;
};

/// Two boxes whose common box is known. Planes are numbered x, y, z of min, then of max.
struct PairBoxes {
  IntBox planes;            ///< those that differ from the common box, or are equal in both
  std::uint8_t owners = 0;  ///< bit i: plane i is the second box's, else the first's
  friend bool operator==(const PairBoxes&, const PairBoxes&) = default;
};

/// Both boxes lie in their common box, and each face of it is a face of one of them.
[[nodiscard]] PairBoxes pair_boxes(const IntBox& first, const IntBox& second);

class PairNodes {
  static_assert(std::endian::native == std::endian::little, "planes are read as words of memory");

 public:
  const std::size_t bytes_per_record;
  [[nodiscard]] static constexpr std::size_t record_bytes(int coord_bits) {
    return (static_cast<std::size_t>(6 * coord_bits + 8) + 7) / 8 + 2 * sizeof(PairChild);
  }

  /// `bvh` needs at least one node; its data is copied. Boxes of branches are taken anew from their children,
  /// so a hierarchy with looser boxes works too. Throws as quantise_box() does.
  PairNodes(const Bvh& bvh, int coord_bits, int finer);

  [[nodiscard]] PairBoxes boxes(std::uint32_t record) const;
  /// The axis along which the branch was split; 0 for the root's own record.
  [[nodiscard]] int split_axis(std::uint32_t record) const;
  [[nodiscard]] PairChild child(std::uint32_t record, unsigned which) const {
    const std::byte* const at = tail(record) + which * sizeof(PairChild);
    PairChild child;
    std::memcpy(&child, at, sizeof child);
    return child;
  }
  /// All records, as they lie in memory.
  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size() / bytes_per_record; }
  /// The node of the hierarchy that child 0 is; child 1 follows it. For those who judge answers.
  [[nodiscard]] std::uint32_t first_node(std::uint32_t record) const { return first_nodes_[record]; }

 private:
  static_assert(sizeof(PairChild) == 8);
  [[nodiscard]] const std::byte* address(std::uint32_t record) const {
    return bytes_.data() + bytes_per_record * record;
  }
  [[nodiscard]] const std::byte* tail(std::uint32_t record) const {
    return address(record) + bytes_per_record - 2 * sizeof(PairChild);
  }
  void append(const PairBoxes& boxes, int split_axis, const std::array<PairChild, 2>& children,
              std::uint32_t first_node);

  int coord_bits_;
  std::vector<std::byte> bytes_;
  std::vector<std::uint32_t> first_nodes_;
};

}  // namespace hitpipe::ref
