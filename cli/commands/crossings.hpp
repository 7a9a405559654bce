// `render --crossings`: how often each of the camera's rays crosses the mesh, in the integer world; or rays at edges
// and corners.
#pragma once

#include <cstdint>
#include <string>

#include "cli/options/scene_options.hpp"
#include "cli/options/trace_options.hpp"
#include "cli/options/world_options.hpp"
#include "cli/text/table.hpp"
#include "rays/tree/load_bvh.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

struct CrossingsChoice {
  bool asked = false;
  std::uint64_t edge_rays = 0;  ///< in place of the camera's; 0: the camera's
  std::uint64_t seed = 1;       ///< of edge_rays
};

/// What the command's other options say.
struct CrossingScene {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy;
  hls::WorldBits world;
  BoxFormatChoice boxes;
  std::string out;  ///< the map of counts; empty: none
};

/// Adds --crossings, --edge-rays and --seed. The command has all its other options already.
void add_crossings_options(CLI::App& command, CrossingsChoice& choice);

/// Counts, draws and prints a row. The exit code is 1 if a line at edges of a closed mesh has an odd count, or one
/// of an oriented closed mesh enters it more often than it leaves it.
int count_crossings(const CrossingScene& chosen, const CrossingsChoice& choice, OutputFormat format);

}  // namespace hitpipe::cli
