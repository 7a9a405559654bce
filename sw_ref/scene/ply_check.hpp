// Checks a PLY file before Assimp reads it. Assimp's reader fills the missing part of a truncated file with
// zeros, allocates what the header claims before it reads, and does not check vertex indices.
#pragma once

#include <filesystem>

namespace hitpipe::ref {

/// Reads through a PLY file (text, or binary of either byte order) without storing it. Every element that the
/// header announces must be there, and every entry of a face's vertex list must be the number of a vertex.
/// Otherwise throws std::runtime_error with the reason, without the file's name.
void check_ply(const std::filesystem::path& file);

}  // namespace hitpipe::ref
