// The built-in scene of a sea on a slope. All its rays are of one direction class.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Matt waves on a plane that leans towards eye and light. Both are placed so that all rays go towards +x,
/// +y, -z.
[[nodiscard]] SceneDescription waves(std::size_t triangles);

}  // namespace hitpipe::ref
