// A picture of how often each of the camera's rays crosses the mesh of an integer scene.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "rays/trace/mesh_crossings.hpp"
#include "rays/world/int_scene.hpp"

namespace hitpipe::ref {

struct CrossingPicture {
  std::vector<float> counts;  ///< by pixel, row by row from the top
  std::uint64_t crossings = 0;
  std::uint64_t most = 0;      ///< of one ray
  std::uint64_t odd_rays = 0;  ///< 0 if the mesh is closed and rays begin outside
  std::uint64_t ties = 0;      ///< CrossingCount::ties of all rays
};

/// One ray without an end through the middle of each pixel. `crossings` is of the scene's mesh and world. The
/// result does not depend on the number of threads. Throws as primary_ray()'s door, int_ray().
[[nodiscard]] CrossingPicture crossing_picture(
    const IntScene& scene, const MeshCrossings& crossings, int width, int height, int threads,
    const std::function<void(double)>& progress = [](double) {});

}  // namespace hitpipe::ref
