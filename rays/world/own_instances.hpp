// Meshes and instances in units of their own, put on grids: the door of instances. Each mesh has a grid whose unit is
// that of the world times a power of two, and each matrix is rounded once.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "hls/world/world_format.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/own_instance.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/world/instances.hpp"

namespace hitpipe::ref {

static_assert(OwnInstance{}.mask == IntInstance::all_masks);

/// The box of all meshes' boxes as the instances have them; nothing without an instance.
[[nodiscard]] std::optional<Bounds> own_bounds(std::span<const SourceMesh> meshes,
                                               std::span<const OwnInstance> instances);

/// A mesh's grid: v = round((own - offset) 2^finer S), where S takes own units to those of the world's grid.
struct MeshGrid {
  glm::dvec3 offset{0.0};
  int finer = 0;
};

/// The grids of meshes for what their instances do: as fine as helps, so small that rays have a matrix
/// (object_space()), and without a rounding where all instances of a mesh are on the lattice.
class InstanceGrids {
 public:
  /// `to_cube` puts all instances into [-1, 1].
  InstanceGrids(std::span<const SourceMesh> meshes, std::span<const OwnInstance> instances,
                const Normalisation& to_cube, const hls::WorldBits& bits);

  [[nodiscard]] const MeshGrid& grid(std::uint32_t mesh) const { return grids_[mesh]; }
  /// Throws as grid_map().
  [[nodiscard]] GridMap map(const OwnInstance& instance) const;
  /// All triangles of the mesh, those without an area too.
  [[nodiscard]] std::vector<IntTriangle> triangles(const SourceMesh& mesh, std::uint32_t number) const;

 private:
  [[nodiscard]] GridMap map_on(const MeshGrid& grid, const OwnInstance& instance) const;

  Normalisation to_cube_;
  double scale_;  ///< S
  std::vector<MeshGrid> grids_;
};

/// The world of these instances. Throws std::runtime_error, one line that names the instance, as IntInstances does.
[[nodiscard]] IntInstances int_instances(std::span<const SourceMesh> meshes,
                                         std::span<const OwnInstance> instances, const InstanceGrids& grids,
                                         const hls::WorldBits& bits, const BuildOptions& options);

}  // namespace hitpipe::ref
