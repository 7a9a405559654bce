// Nodes of the integer hierarchy (chapter 6). Boxes on the n-bit grid (rays/world/int_box.hpp) are
// packed without a gap, as Table 6.1 counts them: six n-bit coordinates, then count and pointer of 4 bytes
// each. That is 20, 23, 26 bytes with n = 16, 20, 24, and ceil(6n / 8) + 8 with any n of 6..32. The
// coordinates of a coarse axis take n - k bits each. Coordinates follow one another, least significant bit
// first, in two's complement: x, y, z of min, then of max. This is a NodeStore
// (sw_ref/hierarchy/node_store.hpp).
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "rays/tree/bvh.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rays/world/int_box.hpp"

namespace hitpipe::ref {

class IntNodes {
  static_assert(std::endian::native == std::endian::little, "coordinates are read as words of memory");

 public:
  using Box = IntBox;
  using Node = std::uint32_t;  ///< index as in Bvh::nodes
  const std::size_t bytes_per_node;
  [[nodiscard]] static std::size_t node_bytes(int coord_bits, const CoarseAxes& coarse = {});

  /// `finer` is as for quantise_box(). `bvh` needs at least one node; its data is copied. Throws as
  /// quantise_box() and coarse_box() do, for n outside 6..32 and for boxes that leave the grid.
  IntNodes(const Bvh& bvh, int coord_bits, const CoarseAxes& coarse = {}, int finer = 0);

  [[nodiscard]] Node root() const { return 0; }
  [[nodiscard]] Node child(Node node, unsigned which) const { return first(node) + which; }
  [[nodiscard]] Box box(Node node) const {
    const std::byte* const at = address(node);
    return {{coordinate(at, 0), coordinate(at, 1), coordinate(at, 2)},
            {coordinate(at, 3), coordinate(at, 4), coordinate(at, 5)}};
  }
  [[nodiscard]] std::int32_t count(Node node) const { return read<std::int32_t>(tail(node)); }
  [[nodiscard]] std::uint32_t first(Node node) const {
    return read<std::uint32_t>(tail(node) + sizeof(std::int32_t));
  }
  [[nodiscard]] std::uint32_t index(Node node) const { return node; }
  [[nodiscard]] std::size_t size() const { return bytes_.size() / bytes_per_node; }
  [[nodiscard]] int coord_bits() const { return coord_bits_; }

 private:
  /// Where a coordinate lies: in the 8 bytes from `byte` on, below the top `above` bits. These 8 bytes never
  /// leave the node, because they start in a coordinate's byte, and 8 bytes follow the coordinates. A read
  /// takes n bits; the bits below `kept` belong to something else and are masked.
  struct Place {
    std::uint32_t byte;
    int above;
    std::int32_t kept;  ///< mask
  };

  static constexpr std::size_t tail_bytes = sizeof(BvhNode::count) + sizeof(BvhNode::first);

  template <class Word>
  static Word read(const std::byte* at) {
    Word word;
    std::memcpy(&word, at, sizeof word);
    return word;
  }
  [[nodiscard]] const std::byte* address(Node node) const { return bytes_.data() + bytes_per_node * node; }
  /// Count and pointer.
  [[nodiscard]] const std::byte* tail(Node node) const { return address(node) + bytes_per_node - tail_bytes; }
  [[nodiscard]] std::int32_t coordinate(const std::byte* node, std::size_t number) const {
    const auto word = read<std::uint64_t>(node + places_[number].byte) << places_[number].above;
    return static_cast<std::int32_t>(static_cast<std::int64_t>(word) >> (64 - coord_bits_)) &
           places_[number].kept;
  }
  void write(std::byte* node, const IntBox& box) const;

  int coord_bits_;
  std::array<Place, 6> places_{};
  std::vector<std::byte> bytes_;
};

}  // namespace hitpipe::ref
