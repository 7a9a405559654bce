// Whether a ray or a scene is one that demands speak of. What is not must not reach a unit fitted to them: it
// would answer wrongly.
#pragma once

#include "sw_ref/demands/scene_demands.hpp"

namespace hitpipe::ref {

/// Throws std::out_of_range, one line that names the demand, for a ray that is none of the demanded ones.
void check_ray_against(const SceneDemands& demands, RayKind kind, const Ray& ray);

/// Throws likewise when `scene` asks for more than `fitted`: another kind of ray, origins, directions or
/// boxes outside, smaller boxes, a deeper hierarchy, a larger leaf.
void check_scene(const SceneDemands& fitted, const SceneDemands& scene);

}  // namespace hitpipe::ref
