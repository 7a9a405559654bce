// The scenes that come with hitpipe, in one table: found by name, listed in messages and help.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

struct BuiltInScene {
  const char* name;
  const char* stands_for;  ///< the scene of figures 4.1, 4.2, 5.4 that it stands in for; empty: none
  std::size_t triangles;   ///< unless others are asked for
  std::size_t least;       ///< triangles; equal to `most` where the scene does not scale
  std::size_t most;
  int lights;
  const char* what;
  SceneDescription (*make)(std::size_t triangles);

  [[nodiscard]] bool scales() const { return least != most; }
};

[[nodiscard]] std::span<const BuiltInScene> built_in_scenes();

/// Null if there is none of that name.
[[nodiscard]] const BuiltInScene* find_built_in(std::string_view name);

/// Of a name that find_built_in() knows; within 2 % of the triangles asked for. Throws std::runtime_error,
/// one line, when the scene cannot have so many.
[[nodiscard]] SceneDescription make_built_in(std::string_view name, std::optional<std::size_t> triangles);

/// With commas between them: all, and those whose triangles can be chosen.
[[nodiscard]] std::string built_in_names();
[[nodiscard]] std::string scaling_names();

}  // namespace hitpipe::ref
