// What a core's image says of itself (docs/core.md), in the blocks behind the root's own record. Software reads it
// before it starts a core.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "rays/scene/normalise.hpp"

namespace hitpipe::ref {

/// Bit i is bit i mod 64 of word i / 64; in memory the words are little-endian, so bit i is in byte i / 8.
using CoreBlock = std::array<std::uint64_t, 4>;
inline constexpr std::size_t core_block_bytes = sizeof(CoreBlock);

struct CoreHeader {
  int coord_bits = 0;           ///< n of the grid
  int levels = 0;               ///< records on a path from the root to a leaf, the root's own counted
  std::uint32_t triangles = 0;  ///< in the image
  std::uint32_t missing = 0;    ///< triangles of the source that the image lacks
  int most_in_leaf = 0;         ///< triangles of one leaf, at most
  Normalisation to_cube{};      ///< from the mesh's own units

  /// Triangles of the source. Their numbers are below it.
  [[nodiscard]] std::uint64_t in_source() const { return std::uint64_t{triangles} + missing; }
  /// Bits that a core needs for a triangle's number. All ones is no triangle.
  [[nodiscard]] int number_bits() const { return static_cast<int>(std::bit_width(in_source())); }
  /// Bits that a core needs for the number of triangles in a leaf. All ones is a record.
  [[nodiscard]] int leaf_bits() const {
    return static_cast<int>(std::bit_width(static_cast<unsigned>(most_in_leaf) + 1));
  }
};

/// They are the blocks 1, 2 and 3.
inline constexpr std::uint32_t header_blocks = 3;

/// Writes the header into an image whose other blocks are there, with their number and a checksum of all of them.
void put_header(std::vector<CoreBlock>& blocks, const CoreHeader& header);
/// Throws std::runtime_error, one line, when there is no header, when it is of another version, when the blocks are not
/// as many as it says, when the checksum differs, and when there is no such grid.
[[nodiscard]] CoreHeader header_of(std::span<const CoreBlock> blocks);

/// The file of an image: blocks in their order.
[[nodiscard]] std::string core_image_bytes(std::span<const CoreBlock> blocks);
/// Throws std::runtime_error, one line, for a number of bytes that is no multiple of a block's.
[[nodiscard]] std::vector<CoreBlock> core_image_blocks(const std::string& bytes);

}  // namespace hitpipe::ref
