// The built-in scenes of a city. It is made of boxes along the axes, seen by an orthographic camera, and lit
// by suns along the axes. So whole families of rays are parallel to an axis, and many meet box faces edge on.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Its plan: seen from straight above with the sun straight above. All rays are exactly (0, -1, 0) or
/// (0, 1, 0).
[[nodiscard]] SceneDescription city(std::size_t triangles);

/// Seen from the south-east at a slant. A second, weak sun stands exactly in the east, so every shadow ray is
/// exactly (0, 1, 0) or (1, 0, 0).
[[nodiscard]] SceneDescription city_oblique(std::size_t triangles);

}  // namespace hitpipe::ref
