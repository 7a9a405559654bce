// What a mesh file says, as triangles.
#pragma once

#include <glm/vec3.hpp>

#include "rays/files/file_mesh.hpp"
#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// All triangles of the faces, those without an area too. Positions are not joined yet. Throws std::runtime_error for
/// too many triangles, for a polygon that crosses itself, and for a corner that is not finite or beyond binary32.
[[nodiscard]] SourceMesh whole_mesh(FileMesh file);

/// Keeps each position that a triangle uses, a dropped one too, once, in the order of first appearance.
void join_positions(SourceMesh& mesh);

[[nodiscard]] bool fits_binary32(const glm::dvec3& p);

}  // namespace hitpipe::ref
