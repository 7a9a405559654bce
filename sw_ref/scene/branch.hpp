// The built-in scene branch.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// A spruce branch with two cones: some thousand bent needles, tiny against the gaps between them.
[[nodiscard]] SceneDescription branch(std::size_t triangles);

}  // namespace hitpipe::ref
