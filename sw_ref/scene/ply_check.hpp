// The guard before Assimp's PLY reader, which fills what a truncated file lacks with zeros, allocates what
// the header claims before it reads, and follows vertex indices without a look at their range.
#pragma once

#include <filesystem>

namespace hitpipe::ref {

/// Walks through a PLY file (text, or binary of either byte order) without storing it.
/// Throws std::runtime_error with the reason, without the file's name, unless every element that the header
/// announces is there and every entry of a face's vertex list is the number of a vertex.
void check_ply(const std::filesystem::path& file);

}  // namespace hitpipe::ref
