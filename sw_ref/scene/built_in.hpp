// The table of built-in scenes. Scenes are found by name, and messages and help list them.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "rays/scene/scene.hpp"

namespace hitpipe::ref {

struct BuiltInScene {
  const char* name;
  const char* stands_for;  ///< the thesis's scene (figures 4.1, 4.2, 5.4) that it stands in for; empty: none
  std::size_t triangles;   ///< the default number
  std::size_t least;       ///< triangles; equal to `most` if the scene does not scale
  std::size_t most;
  int lights;
  const char* what;
  BuiltInDescription (*make)(std::size_t triangles);

  [[nodiscard]] bool scales() const { return least != most; }
};

[[nodiscard]] std::span<const BuiltInScene> built_in_scenes();

/// Null if there is no scene of that name.
[[nodiscard]] const BuiltInScene* find_built_in(std::string_view name);

/// Makes the scene; find_built_in() must know the name. The number of triangles is within 2 % of the wanted
/// one. Throws std::runtime_error, one line, if the scene cannot have that number.
[[nodiscard]] SceneDescription make_built_in(std::string_view name, std::optional<std::size_t> triangles);

/// Names separated by commas: all scenes, and those whose number of triangles can be chosen.
[[nodiscard]] std::string built_in_names();
[[nodiscard]] std::string scaling_names();

}  // namespace hitpipe::ref
