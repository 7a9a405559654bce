// A hierarchy of boxes from a text file (docs/scenes.md), as it is written there: any number of children,
// boxes in the scene's own units or in the cube, triangles by their numbers in the source.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

/// Where the boxes of a file are.
enum class FileSpace : std::uint8_t {
  scene,  ///< in the scene's own units, not padded
  cube,   ///< in the cube and padded, to be taken as they are
};

struct FileNode {
  static constexpr std::int8_t no_split = -1;

  Aabb box;
  std::uint32_t first;  ///< leaf: first entry of BvhFile::triangles; branch: of BvhFile::children
  std::uint32_t count;  ///< of triangles or children
  std::uint32_t line;   ///< of the file
  bool is_leaf;
  std::int8_t split;  ///< branch: the stated axis 0..2, or no_split
};

struct BvhFile {
  std::filesystem::path path;
  FileSpace space = FileSpace::scene;
  std::vector<FileNode> nodes;  ///< at least one; the first is the root
  std::vector<std::uint32_t> children;
  std::vector<std::uint32_t> triangles;
  std::vector<std::uint32_t> from_root;  ///< all nodes, parents before children

  /// Throw std::runtime_error, one line that names the file, and the node and its line.
  [[noreturn]] void reject(const std::string& reason) const;
  template <class... Parts>
  [[noreturn]] void reject(const FileNode& node, fmt::format_string<Parts...> reason,
                           Parts&&... parts) const {
    reject(fmt::format("line {}: node {} {}", node.line, number(node),
                       fmt::format(reason, std::forward<Parts>(parts)...)));
  }
  [[nodiscard]] std::uint32_t number(const FileNode& node) const {
    return static_cast<std::uint32_t>(&node - nodes.data());
  }
  /// The triangles of a leaf or the children of a branch.
  [[nodiscard]] std::span<std::uint32_t> entries(const FileNode& node) {
    return std::span(node.is_leaf ? triangles : children).subspan(node.first, node.count);
  }
};

/// Reads the words of the file: all boxes have numbers and are not inverted, the nodes are a tree, and each entry of
/// the list of triangles is in one leaf. A leaf without triangles may have any box. Throws std::runtime_error, one
/// line that names the file, the line, and what is allowed.
[[nodiscard]] BvhFile read_bvh_file(const std::filesystem::path& file);

/// The text of such a file, in the cube. Reading it gives the same hierarchy, bit for bit.
[[nodiscard]] std::string bvh_text(const Bvh& bvh, const Mesh& mesh);

}  // namespace hitpipe::ref
