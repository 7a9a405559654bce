// The options of commands that repeat experiments of the thesis: scenes, sizes, repeats.
#pragma once

#include "thesis/experiment.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

/// Adds --scene, --only, --width, --height, --triangles, --repeats, --threads. The command must keep the
/// options alive.
void add_experiment_options(CLI::App& command, thesis::ExperimentOptions& options);

}  // namespace hitpipe::cli
