// The triangles of a mesh file, in the order of its faces.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/files/file_mesh.hpp"

namespace hitpipe::ref {

/// A face with n >= 3 corners gives n - 2 triangles, one after the other; others give none. Takes `mesh.corners`
/// where all faces are triangles. Throws std::runtime_error, one line that names the face, counted from 0, for a
/// polygon that triangulate() refuses, and when there are more triangles than can be numbered.
[[nodiscard]] std::vector<glm::uvec3> triangles_of(FileMesh& mesh);

/// Of each face: the number of triangles before it. Empty where all faces are triangles.
[[nodiscard]] std::vector<std::uint32_t> first_numbers(const FileMesh& mesh);

}  // namespace hitpipe::ref
