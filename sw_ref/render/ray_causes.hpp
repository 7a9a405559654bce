// The kinds of rays that the surfaces and lights of a scene can cause, found once for the scene. What is not
// listed here never happens in any pixel, so a renderer needs no test and no memory for it.
#pragma once

#include <cstdint>
#include <vector>

#include "rays/scene/scene.hpp"
#include "sw_ref/render/whitted_options.hpp"

namespace hitpipe::ref {

struct RayCauses {
  bool scatters = false;              ///< some surface is not black
  bool mirrors = false;               ///< some surface mirrors, perhaps only by total reflection
  bool refracts = false;              ///< some surface transmits rays; then it also mirrors
  bool scattered = false;             ///< matt surfaces send rays on in random directions
  bool occlusion = false;             ///< and find how open their place is
  std::vector<std::uint32_t> lights;  ///< indices of the lights whose light some surface scatters
  bool smooth = false;                ///< surfaces have shading normals of their own

  [[nodiscard]] bool secondary() const { return mirrors || scattered; }
  [[nodiscard]] bool shadow() const { return !lights.empty() || occlusion; }
};

/// Considers the materials that triangles use. Without bounces nothing mirrors, refracts or sends on.
[[nodiscard]] RayCauses ray_causes(const Scene& scene, const WhittedOptions& options);

}  // namespace hitpipe::ref
