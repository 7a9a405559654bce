// A scene as the traversal core reads it from memory (docs/core.md): blocks of 32 bytes, each a record of two
// boxes or a triangle of the integer world. Block 0 is the root's own record, and the header follows it
// (core_header.hpp). Lines of memory have 64 bytes, so an image has an even number of blocks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "rays/image/core_header.hpp"
#include "rays/world/int_scene.hpp"
#include "rays/world/pair_nodes.hpp"

namespace hitpipe::ref {

/// Two boxes, and what is in them. The blocks of child 0 begin at `pointer`, and those of child 1 follow: a
/// record has one block, a leaf one for each triangle.
struct CoreRecord {
  static constexpr int most_in_leaf = 254;

  PairBoxes boxes;
  std::uint32_t pointer = 0;
  /// As PairChild::count; a leaf has at most most_in_leaf triangles.
  std::array<std::int32_t, 2> counts{PairChild::none, PairChild::none};

  /// With the block at which it begins.
  [[nodiscard]] PairChild child(unsigned which) const;
  friend bool operator==(const CoreRecord&, const CoreRecord&) = default;
};
struct CoreTriangle {
  IntTriangle triangle;
  std::uint32_t number = 0;  ///< all ones is no triangle
  friend bool operator==(const CoreTriangle&, const CoreTriangle&) = default;
};

/// The place of each bit is in docs/core.md. A block says what it is, and how many bits n its grid has.
[[nodiscard]] CoreBlock to_block(const CoreRecord& record, int coord_bits);
[[nodiscard]] CoreBlock to_block(const CoreTriangle& triangle, int coord_bits);
[[nodiscard]] CoreRecord record_of(const CoreBlock& block);
[[nodiscard]] CoreTriangle triangle_of(const CoreBlock& block);

struct CoreImage {
  /// Records on a path from the root to a leaf, the root's own counted.
  static constexpr int most_levels = 60;

  std::vector<CoreBlock> blocks;  ///< the header among them
  CoreHeader header;
  std::uint32_t records = 0;

  [[nodiscard]] std::uint64_t bytes() const { return blocks.size() * core_block_bytes; }
};

/// Triangles have their numbers in the source of the mesh (TriangleNumbers). A leaf with more triangles than a
/// record can count is split into halves. Throws std::runtime_error, one line, when the hierarchy has more
/// levels than the core's trail.
[[nodiscard]] CoreImage core_image(const IntScene& scene);

/// Reads an image again from its blocks and counts what is in it. Throws std::runtime_error, one line, as
/// header_of() does, and when the header does not tell the truth. It also throws, and names the block, when a
/// child lies outside, a block is of another kind or another grid, is reached twice or never, a record has a
/// plane outside the cube or bits without a meaning that are not 0, the boxes of a leaf do not hold its triangles
/// whole, a record's boxes are not the common box that its parent promises, a triangle has no number, another's or
/// no area, or a path is too long.
[[nodiscard]] CoreImage checked_image(std::vector<CoreBlock> blocks);

}  // namespace hitpipe::ref
