// Checks that a ray meets demands. No other ray may reach a unit that is fitted to the demands,
// because the unit would answer wrongly.
#pragma once

#include "sw_ref/quantise/scene_demands.hpp"

namespace hitpipe::ref {

/// Throws std::out_of_range, one line that names the demand, if the ray breaks a demand.
void check_ray_against(const SceneDemands& demands, RayKind kind, const Ray& ray);

}  // namespace hitpipe::ref
