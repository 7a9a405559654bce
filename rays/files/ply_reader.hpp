// Reader of PLY 1.0: text, and binary of either byte order.
#pragma once

#include <string_view>

#include "rays/files/file_mesh.hpp"

namespace hitpipe::ref {

/// The mesh of a PLY file. Read are x, y, z of the element vertex and the list vertex_indices or vertex_index
/// of the element face; these may follow each other in any order. Every other property and element is
/// skipped. Numbers of a text body have white space between them, wherever lines end. Throws
/// std::runtime_error, one line without the file's name, for a header that read_ply_header() refuses, too few
/// or too many numbers, a coordinate of a face that is not finite or does not have its type, an index that is
/// not the number of a vertex, and for text or bytes behind the last element that are not line ends.
[[nodiscard]] FileMesh read_ply(std::string_view bytes);

}  // namespace hitpipe::ref
