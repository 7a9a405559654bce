// The options by which every command that renders chooses and places its scene.
#pragma once

#include <string>
#include <vector>

#include "rays/scene/scene.hpp"
#include "rays/world/int_scene.hpp"
#include "sw_ref/scene/load_scene.hpp"

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
  bool strict = false;  ///< triangles that lose their area are an error
  std::string faces;    ///< a file to write; empty: none

  /// Says on standard error which triangles lose their area, and writes the file of faces. Throws what
  /// ref::load_scene() throws; and std::runtime_error, one line, for lost triangles if that is strict, and for a
  /// ray of the picture that begins outside a chosen cube.
  [[nodiscard]] ref::Scene load() const;
  /// The same of a scene that has been read.
  [[nodiscard]] ref::Scene placed(ref::SceneDescription description) const;
  /// The same scene in the integer world. Says what it loses there, and throws, likewise.
  [[nodiscard]] ref::IntScene in_integers(const ref::Scene& scene, const hls::WorldBits& bits,
                                          const ref::HierarchyOptions& hierarchy) const;
  /// Throws std::runtime_error, one line, for a ray of the picture that begins outside a chosen cube. `option`
  /// chose it.
  void check_rays(const ref::Camera& camera, const std::string& option) const;
};

/// Adds --scene (required), --triangles, --eye, --target, --up, --fov, --orthographic, --perspective, --light,
/// --sun, --cube, --strict, --faces, --width, --height, --threads.
void add_scene_options(CLI::App& command, SceneChoice& choice);
/// Adds --cube, --strict and --faces alone.
void add_cube_options(CLI::App& command, SceneChoice& choice);

/// The names of all options that add_scene_options() adds.
[[nodiscard]] std::vector<std::string> scene_option_names();

}  // namespace hitpipe::cli
