// A scene in the integer world: its mesh on the grid and a hierarchy over it.
#pragma once

#include <optional>

#include "hls/world/world_format.hpp"
#include "rays/scene/scene.hpp"
#include "rays/tree/load_bvh.hpp"
#include "rays/world/int_mesh.hpp"

namespace hitpipe::ref {

struct IntScene {
  hls::WorldBits bits;
  IntMesh mesh;
  Scene scene;             ///< with the integer mesh in place of its own
  std::optional<Bvh> bvh;  ///< nothing: the mesh has no triangle

  [[nodiscard]] const Bvh* hierarchy() const { return bvh ? &*bvh : nullptr; }
};

/// The scene's mesh must be in the cube. Boxes are not padded: the options' padding is ignored. A hierarchy
/// of a file keeps its branches, and its boxes become those of the integer mesh. Throws as int_mesh() and
/// make_hierarchy().
[[nodiscard]] IntScene int_scene(const Scene& scene, const hls::WorldBits& bits,
                                 const HierarchyOptions& hierarchy = {});

}  // namespace hitpipe::ref
