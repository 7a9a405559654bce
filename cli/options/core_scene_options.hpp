// The options by which a command chooses what a core traces: a scene, or the image of one in a file.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cli/options/scene_options.hpp"
#include "cli/text/table.hpp"
#include "hls/world/world_format.hpp"
#include "rays/image/core_image.hpp"
#include "rays/tree/load_bvh.hpp"
#include "rays/world/int_scene.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace hitpipe::cli {

/// What a core traces, in memory and as software knows it.
struct CoreScene {
  std::shared_ptr<const ref::IntScene> scene;
  ref::CoreImage image;
  Row mesh;               ///< what is said of its triangles
  Row notes;              ///< camera_notes()
  std::string hierarchy;  ///< how it was built, or that the image has it
};

struct CoreSceneChoice {
  SceneChoice scene;
  ref::HierarchyOptions hierarchy{.build = ref::surface_area_build};
  std::string image;  ///< a file in place of the scene; empty: none

  /// The image of the file; nothing if the user chose a scene. Throws std::runtime_error, "FILE: ...", for a file
  /// that is no image.
  [[nodiscard]] std::optional<ref::CoreImage> stored() const;
  /// Reads the scene and makes its image; or makes a scene of `stored`. `bits` is the format as the user knows
  /// it. Throws as SceneChoice, core_image() and image_scene() do, and std::runtime_error, one line, when the
  /// image has another grid.
  [[nodiscard]] CoreScene load(std::optional<ref::CoreImage> stored, const hls::WorldBits& world,
                               const std::string& bits) const;
};

/// The image of a file. Throws std::runtime_error, "FILE: ...", for a file that is none.
[[nodiscard]] ref::CoreImage read_core_image(const std::string& file);
/// Throws std::runtime_error, one line, when the image has another n. `bits` is the format as the user knows it.
void check_grid(const ref::CoreImage& image, const hls::WorldBits& world, const std::string& bits);

struct CoreSceneOptions {
  CLI::Option *scene, *image;
};
/// Adds the options of a scene, which none requires, those of its hierarchy, and --image.
CoreSceneOptions add_core_scene_options(CLI::App& command, CoreSceneChoice& choice);

}  // namespace hitpipe::cli
