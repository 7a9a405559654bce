// Camera, lights and a material for a mesh file, which has none.
#pragma once

#include <string>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Camera in front, a little above and to the right; a warm light at its upper left, a weaker one at its
/// right. A room is seen and lit from inside.
[[nodiscard]] SceneDescription mesh_scene(Mesh mesh, std::string name);

}  // namespace hitpipe::ref
