// What commands say of a mesh: is it closed, and where not.
#pragma once

#include <span>

#include "cli/text/table.hpp"
#include "rays/scene/scene.hpp"
#include "rays/tree/closed.hpp"

namespace hitpipe::cli {

/// In the scene's own units, with the numbers that triangles have in the file. `vertices` are those of the mesh before
/// it was moved. A truth is yes or no, in JSON true or false.
[[nodiscard]] Row closed_row(const ref::Scene& scene, std::span<const glm::dvec3> vertices,
                             OutputFormat format);

/// Whether lines of the integer world cross the mesh evenly.
[[nodiscard]] Row even_row(const ref::Closedness& found, OutputFormat format);

}  // namespace hitpipe::cli
