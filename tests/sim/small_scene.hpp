// Two small scenes made in code: hills under two lights, and the same seen by a camera outside the cube.
#pragma once

#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::sim {

/// 288 triangles over a square, smooth in x and stepped in z, so that rays meet, graze and miss boxes; two
/// lights.
[[nodiscard]] ref::Scene hills();

/// The same with the camera outside the cube, so no unit accepts a primary ray.
[[nodiscard]] ref::Scene hills_from_outside();

}  // namespace hitpipe::sim
