// The built-in scene of a landscape as a scanner sees it. Eye and sun stand so low that all rays are nearly
// flat to the surface.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Hills, ridges and a plain, of measured points: a little out of their grid, with noise in their heights.
[[nodiscard]] SceneDescription terrain(std::size_t triangles);

}  // namespace hitpipe::ref
