// The built-in scene poppy.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// A clump of poppies: thin curved petals, stamens, seed pods, buds, and hair on every stem.
[[nodiscard]] SceneDescription poppy(std::size_t triangles);

}  // namespace hitpipe::ref
