// Checks that a ray or a scene meets demands. No other ray may reach a unit that is fitted to the demands,
// because the unit would answer wrongly.
#pragma once

#include "sw_ref/demands/scene_demands.hpp"

namespace hitpipe::ref {

/// Throws std::out_of_range, one line that names the demand, if the ray breaks a demand.
void check_ray_against(const SceneDemands& demands, RayKind kind, const Ray& ray);

/// Throws in the same way if `scene` demands more than `fitted`: another kind of ray, origins, directions or
/// boxes outside the bounds, smaller boxes, a deeper hierarchy, a larger leaf.
void check_scene(const SceneDemands& fitted, const SceneDemands& scene);

}  // namespace hitpipe::ref
