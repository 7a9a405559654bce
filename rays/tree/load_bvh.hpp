// Where a hierarchy comes from: it is built, or taken from a file and given the form of our own
// (docs/scenes.md).
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

struct LoadedBvh {
  Bvh bvh;
  std::size_t boxes_grown = 0;  ///< nodes of the file whose boxes were too small by a rounding
};

/// A branch with more than two children is split into branches of two, and one with a single child is
/// replaced by it. Boxes are moved into the cube with the scene, rounded outward and padded, unless the file
/// says that they are in the cube already. Throws std::runtime_error, one line that names the file, for a
/// file that cannot be read, that is not a tree of boxes over all triangles of the scene, or that has more
/// than BuildOptions::deepest levels.
[[nodiscard]] LoadedBvh load_bvh(const std::filesystem::path& file, const Scene& scene,
                                 float padding = BuildOptions{}.padding);

struct HierarchyOptions {
  BuildOptions build{};
  std::filesystem::path file{};  ///< empty: it is built; else `build` only says how boxes are padded

  /// "median 6", "sah 2": the builder and the most triangles of a leaf; or the file's name.
  [[nodiscard]] std::string name() const;
  /// The same as a reader expects it: "surface-area tree, at most 2 triangles a leaf".
  [[nodiscard]] std::string text() const;
};

/// Throws what build_bvh() and load_bvh() throw.
[[nodiscard]] LoadedBvh make_hierarchy(const Scene& scene, const HierarchyOptions& options);

}  // namespace hitpipe::ref
