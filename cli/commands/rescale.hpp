// `--rescale` of cosim and render: a scene in other units and at other places.
#pragma once

#include <string>
#include <vector>

#include "cli/options/design_options.hpp"
#include "cli/options/scene_options.hpp"
#include "cli/text/table.hpp"
#include "sim/check/rescale.hpp"

namespace hitpipe::cli {

/// A transform, with the text by which the user gave it.
struct NamedTransform {
  std::string name;
  sim::Transform transform;
};

struct RescaleChoice {
  bool asked = false;
  ref::BuildOptions build{};  ///< of each picture's hierarchy; set by the command
  std::vector<NamedTransform> scales;
  std::vector<NamedTransform> offsets;
};

/// Adds --rescale, --scale and --offset. The command has all its other options already; with
/// --rescale it allows the options of the scene, --format and `used`.
void add_rescale_options(CLI::App& command, RescaleChoice& choice, const std::vector<std::string>& used);

/// Renders the pictures, prints a row for each and returns the exit code. Without a design in software alone.
[[nodiscard]] int rescale(const SceneChoice& chosen, const RescaleChoice& choice, const DesignChoice* design,
                          OutputFormat format);

}  // namespace hitpipe::cli
