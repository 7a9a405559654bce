// The thesis's scenes (figures 4.1, 4.2, 5.4), or their stand-ins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rays/scene/scene.hpp"
#include "thesis/experiment.hpp"
#include "thesis/reference.hpp"

namespace hitpipe::thesis {

/// The names in a printed table's first column, each once and in order, without those that options.only
/// excludes. Throws std::runtime_error, one line, if options.only names a scene that the table does not have.
[[nodiscard]] std::vector<std::string> scenes_of_table(std::string_view number,
                                                       const ExperimentOptions& options);

/// The scene to use for the thesis's scene of that name: the given one, or the built-in stand-in; nothing if
/// there is neither. Throws as load_scene does.
[[nodiscard]] std::optional<Scene> test_scene(const std::string& name, const ExperimentOptions& options);

/// A note for the reader that says what was rendered in place of `name`.
[[nodiscard]] std::string scene_note(const std::string& name, const std::optional<Scene>& scene);

}  // namespace hitpipe::thesis
