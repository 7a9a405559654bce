// The built-in scene branch.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// A spruce branch with two cones. It has thousands of bent needles, which are tiny compared with the gaps
/// between them.
[[nodiscard]] SceneDescription branch(std::size_t triangles);

}  // namespace hitpipe::ref
