// What the thesis proposes in section 8.2 and did not run. It prints no figures, so ours stand alone.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rays/scene/scene.hpp"
#include "thesis/experiment.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

/// The built-in scenes, or the scenes of options.only. Throws std::runtime_error for another name.
[[nodiscard]] std::vector<std::string> proposal_scenes(std::string_view number,
                                                       const ExperimentOptions& options);
/// With options.triangles where the scene can have as many.
[[nodiscard]] Scene proposal_scene(const std::string& name, const ExperimentOptions& options);

/// A small unit of n1 bits answers "hit", "miss" or "ask again with more bits", and a large unit of n2 bits
/// is asked only then. A row for each built-in scene and figure, a column for each n1. options.only: names of
/// built-in scenes.
[[nodiscard]] ResultTable adaptive_precision(std::string_view number, const ExperimentOptions& options);
[[nodiscard]] ResultTable kd_planes(std::string_view number, const ExperimentOptions& options);
[[nodiscard]] ResultTable grid_cells(std::string_view number, const ExperimentOptions& options);

}  // namespace hitpipe::thesis
