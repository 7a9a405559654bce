// What a block of a core's image is (docs/core.md). Its last byte says so, and how many bits its grid has, so a
// core sees that memory gave it something else than it wanted.
#pragma once

#include <cstdint>

namespace hitpipe {
namespace hls {

/// Of the layout of an image, in its header.
constexpr int image_version = 2;

/// The upper three bits of the byte. A block of zeros is of no kind.
enum BlockKind : std::uint8_t { record_block = 0x40, triangle_block = 0x60 };

/// The byte: the kind, and n of the grid in the lower five bits.
constexpr int kind_byte(BlockKind kind, int coord_bits) {
  return kind | coord_bits;
}

}  // namespace hls
}  // namespace hitpipe
