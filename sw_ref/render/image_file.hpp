// Writer of image files, through OpenImageIO.
#pragma once

#include <filesystem>
#include <vector>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// Writes linear colours, row by row from the top: .png as 8-bit sRGB, .exr as linear half floats. The file
/// appears whole or not at all: it is written beside its place under another name, then renamed. Throws
/// std::runtime_error, one line, for an unknown extension, a place that cannot be written, or a size that
/// does not match `linear`.
void write_image(const std::filesystem::path& file, int width, int height,
                 const std::vector<glm::vec3>& linear);

}  // namespace hitpipe::ref
