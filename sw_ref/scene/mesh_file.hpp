// Reader of mesh files: OBJ, PLY, STL, glTF and GLB, through Assimp.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "sw_ref/scene/mesh.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// All triangles of a file in its own units: node transforms applied, polygons triangulated, points and lines
/// left out, equal positions joined, triangles without area dropped and counted. At least one triangle
/// remains. Throws std::runtime_error, one line that names the file and what is allowed, if the file is
/// missing, not a regular file, empty, cut short or malformed, or if it has an unknown extension, a
/// coordinate that is not finite, an index out of range, or no triangle with area.
[[nodiscard]] Mesh load_mesh(const std::filesystem::path& file);

/// Consecutive triangles of a file that have one name and one material there; names may be empty.
struct MeshGroup {
  std::string name;
  std::string material;
  std::optional<Material> surface;  ///< of an OBJ with materials: what its MTL file says (obj_material.hpp)
  std::uint32_t first = 0;          ///< triangle of the mesh
  std::uint32_t count = 0;
};

/// The same, and also the groups of the triangles. The groups follow one another and cover the mesh.
[[nodiscard]] Mesh load_mesh(const std::filesystem::path& file, std::vector<MeshGroup>& groups);

}  // namespace hitpipe::ref
