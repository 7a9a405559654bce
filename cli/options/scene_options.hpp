// The options by which every command that renders chooses and places its scene.
#pragma once

#include <string>

#include "sw_ref/scene/scene.hpp"

namespace CLI {
class App;
}

namespace hitpipe::cli {

struct SceneChoice {
  std::string name;           ///< a built-in scene, a scene file or a mesh file
  ref::SceneOptions placing;  ///< what the user changes in the scene
  int width = 256;
  int height = 256;
  int threads = 1;

  /// Throws what ref::load_scene() throws.
  [[nodiscard]] ref::Scene load() const { return ref::load_scene(name, placing); }
};

/// Adds --scene (required), --triangles, --eye, --target, --up, --fov, --orthographic, --perspective,
/// --light, --sun, --width, --height, --threads.
void add_scene_options(CLI::App& command, SceneChoice& choice);

}  // namespace hitpipe::cli
