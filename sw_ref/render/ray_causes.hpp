// What the surfaces and lights of a scene can cause, found once for all its rays: what is not listed here
// never happens, whichever pixels are asked for, so that whoever traces it needs neither test nor memory.
#pragma once

#include <cstdint>
#include <vector>

#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

struct RayCauses {
  bool scatters = false;              ///< some surface is not black
  bool mirrors = false;               ///< some surface mirrors, if only by total reflection
  bool refracts = false;              ///< some surface passes rays on; it mirrors, too
  std::vector<std::uint32_t> lights;  ///< indices of those that some surface scatters light of
  bool smooth = false;                ///< surfaces have shading normals of their own

  [[nodiscard]] bool secondary() const { return mirrors; }
  [[nodiscard]] bool shadow() const { return !lights.empty(); }
};

/// By the materials that triangles use. Without bounces nothing mirrors or refracts.
[[nodiscard]] RayCauses ray_causes(const Scene& scene, int bounces);

}  // namespace hitpipe::ref
