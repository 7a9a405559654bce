// Refuses rays that are outside the demands of a scene. A unit fitted to the demands would answer them
// wrongly.
#pragma once

#include "sw_ref/demands/scene_demands.hpp"

namespace hitpipe::ref {

/// Throws std::out_of_range, one line that names the demand, for a ray that is none of the demanded ones.
void check_ray(const SceneDemands& demands, RayKind kind, const Ray& ray);

}  // namespace hitpipe::ref
