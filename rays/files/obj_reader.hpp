// Reader of OBJ files (Wavefront, version 3.0), and of the MTL files that they name.
#pragma once

#include <filesystem>
#include <string_view>

#include "rays/files/file_mesh.hpp"

namespace hitpipe::ref {

/// The faces of an OBJ file (`f`, and `fo` of version 2.11). A vertex has x, y, z; a fourth number is the
/// weight of rational curves, which no polygon uses; 6 or 7 numbers are a position with a colour. Indices of
/// texture coordinates and normals are not looked up. A group is named by the last `o` or `g` and has the
/// last `usemtl`. `file` is where the text was: it finds the files of `mtllib`, or else one with its own name
/// and .mtl. Throws std::runtime_error, one line without the name of the OBJ file, if a line is wrong or
/// unknown.
[[nodiscard]] FileMesh read_obj(std::string_view text, const std::filesystem::path& file);

}  // namespace hitpipe::ref
