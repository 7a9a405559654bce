// The built-in scenes statue and two_statues.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// A winged figure that holds up a torch, on a floor that mirrors a little. Its closed surfaces are displaced
/// by folds, feathers and noise. The triangles are tiny and of one size.
[[nodiscard]] SceneDescription statue(std::size_t triangles);

/// Two of these figures; the second has 15/43 of the triangles, as in figure 5.4.
[[nodiscard]] SceneDescription two_statues(std::size_t triangles);

}  // namespace hitpipe::ref
