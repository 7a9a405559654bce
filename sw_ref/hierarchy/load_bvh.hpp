// Takes a hierarchy from a file and gives it the form of our own (docs/scenes.md).
#pragma once

#include <cstddef>
#include <filesystem>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/scene/scene.hpp"

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

}  // namespace hitpipe::ref
