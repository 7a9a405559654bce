// Mesh files: OBJ, PLY, STL, glTF and GLB, each read as its format says, or refused.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rays/mesh/mesh.hpp"
#include "rays/mesh/own_instance.hpp"
#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

/// All triangles of a file in its own units: polygons are cut into triangles, faces of one or two corners are
/// left out, equal positions are joined, and triangles without area are dropped and counted. At least one
/// triangle remains. Throws std::runtime_error, one line that names the file, the place in it and what is allowed, if
/// the file is missing, not a regular file, empty, cut short or malformed, if it has an unknown extension, a
/// coordinate that is not finite or beyond binary32, or an index out of range, if a polygon crosses itself, or if no
/// triangle has an area.
[[nodiscard]] SourceMesh load_mesh(const std::filesystem::path& file);

/// Consecutive triangles of a file that have one name and one material there; names may be empty.
struct MeshGroup {
  std::string name;
  std::string material;
  std::optional<Material> surface;  ///< of an OBJ with materials: what its MTL file says (mtl_reader.hpp)
  std::uint32_t first = 0;          ///< triangle of the mesh
  std::uint32_t count = 0;
};

/// The same, and also the groups of the triangles. The groups follow one another and cover the mesh.
[[nodiscard]] SourceMesh load_mesh(const std::filesystem::path& file, std::vector<MeshGroup>& groups);
/// The same of bytes in memory. The file's name says the format, and the files that a mesh names are beside it.
[[nodiscard]] SourceMesh load_mesh(std::string_view bytes, const std::filesystem::path& file,
                                   std::vector<MeshGroup>& groups);

/// The meshes of a file, each once, and where they are: of glTF the nodes with a mesh and their instances, of another
/// format one instance that stays where it is. Their triangles, one instance behind the other and with two corners
/// swapped where an instance mirrors, are those of the file, up to the rounding of products. So a mesh keeps
/// triangles without area, and a triangle's number is that of the file. Throws as load_mesh(), but for scenes
/// that are too large only when flattened, and for positions outside binary32 tells of corners of a mesh's box.
[[nodiscard]] OwnInstances load_instances(const std::filesystem::path& file);
[[nodiscard]] OwnInstances load_instances(std::string_view bytes, const std::filesystem::path& file);
/// Whether files with this extension may have instances.
[[nodiscard]] bool may_have_instances(const std::filesystem::path& file);

}  // namespace hitpipe::ref
