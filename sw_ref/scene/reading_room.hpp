// The built-in scene of a library's reading room. Nearly all of it is boxes along the axes, and the sun
// stands straight above its skylights, so every shadow ray is exactly (0, 1, 0) and runs inside or along
// faces.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Shelves of books on two floors, desks with lamps, and a roof with eight skylights, seen from inside.
[[nodiscard]] SceneDescription reading_room(std::size_t triangles);

}  // namespace hitpipe::ref
