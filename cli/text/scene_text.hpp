// What commands say of the scene that they have read: which triangles it keeps, and which are lost, and why.
#pragma once

#include <filesystem>
#include <string>

#include "cli/text/table.hpp"
#include "rays/world/int_scene.hpp"

namespace hitpipe::cli {

/// Triangles that are there, that have no area in the file, and that lose it here; the part of the cube's side
/// that the mesh has.
[[nodiscard]] Row scene_row(const ref::Scene& scene);
/// In the integer world; also the largest movement of a corner, in units of the cube.
[[nodiscard]] Row scene_row(const ref::IntScene& scene);

/// Of a scene from an image, which knows how many triangles of its source are missing, and not why.
[[nodiscard]] Row image_row(const ref::IntScene& scene);

/// The same in words, for a line.
[[nodiscard]] std::string summary_of(const Row& scene);

/// One line: how many triangles lose their area, why, and what would keep them. Empty if none does.
[[nodiscard]] std::string lost_text(const ref::Scene& scene);
/// The same of those that the integer world loses. `scene` is what `integers` were made of.
[[nodiscard]] std::string lost_text(const ref::Scene& scene, const ref::IntScene& integers);

/// Writes by triangle its number and the face of the file that it is part of, as CSV: all triangles of the file.
void write_faces(const std::filesystem::path& file, const ref::Mesh& mesh);

}  // namespace hitpipe::cli
