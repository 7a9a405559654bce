// The built-in scenes statue and two_statues.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// A winged figure that holds up a torch, its closed surfaces displaced by folds, feathers and noise, on a
/// floor that mirrors a little. The triangles are tiny and of one size.
[[nodiscard]] SceneDescription statue(std::size_t triangles);

/// Two of them; the second has 15 of 43 parts of the triangles, as in figure 5.4.
[[nodiscard]] SceneDescription two_statues(std::size_t triangles);

}  // namespace hitpipe::ref
