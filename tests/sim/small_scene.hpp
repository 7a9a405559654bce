// Two small scenes made in code: hills under two lights, and what a camera outside the cube sees of them.
#pragma once

#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::sim {

/// 288 triangles over a square, smooth in x and stepped in z, so that rays meet, graze and miss boxes; two
/// lights.
[[nodiscard]] ref::Scene hills();

/// The same, its camera moved out of the cube: no unit accepts a primary ray.
[[nodiscard]] ref::Scene hills_from_outside();

}  // namespace hitpipe::sim
