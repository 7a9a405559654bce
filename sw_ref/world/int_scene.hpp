// A scene in the integer world: its mesh on the grid, a hierarchy over it, and what its surfaces look like.
#pragma once

#include <optional>

#include "hls/world/world_format.hpp"
#include "sw_ref/hierarchy/load_bvh.hpp"
#include "sw_ref/render/shade.hpp"
#include "sw_ref/scene/scene.hpp"
#include "sw_ref/world/int_mesh.hpp"

namespace hitpipe::ref {

/// How far beside a surface its rays start: two units of the corners' grid, and at least as far as in the
/// float world. At one unit and less, many shadow rays hit the surface that they leave.
[[nodiscard]] double int_offset(const hls::WorldBits& bits);

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

/// Surfaces from the triangle and the exact weights of its corners, so that an image is the same on every
/// machine.
class IntSurfaces final : public Surfaces {
 public:
  /// The scene must outlive it.
  explicit IntSurfaces(const IntScene& scene) : scene_(&scene) {}
  /// Throws std::logic_error when the ray does not meet the triangle.
  [[nodiscard]] SurfacePoint point(std::uint32_t triangle, const Ray& ray) const override;

 private:
  const IntScene* scene_;
};

}  // namespace hitpipe::ref
