// The built-in scene of a sea on a slope: all its rays can be bounded to one direction class.
#pragma once

#include <cstddef>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Waves on a plane that leans towards eye and light, both so placed that all rays go towards +x, +y, -z.
/// Matt.
[[nodiscard]] SceneDescription waves(std::size_t triangles);

}  // namespace hitpipe::ref
