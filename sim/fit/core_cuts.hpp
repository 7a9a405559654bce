// What a fit leaves out of a core: what the scenes' images need, by bounds, and what each cut saves.
#pragma once

#include <cstdint>
#include <vector>

#include "sim/fit/core_fit.hpp"

namespace hitpipe::sim {

/// Of all scenes the most.
struct CoreNeeds {
  int levels = 0;
  int most_in_leaf = 0;
  std::uint64_t triangles = 0;  ///< of the source; their numbers are below it
  std::uint64_t blocks = 0;
  std::uint64_t steps = 0;  ///< records that a ray of the pictures tests
};
[[nodiscard]] CoreNeeds needs_of(const std::vector<CoreFitScene>& scenes);

/// Steps that a ray may make, against the most that one of the pictures makes: other rays go other ways.
inline constexpr std::uint64_t spare_steps = 16;

/// The same boxes in another world.
[[nodiscard]] hls::RayBits with_world(hls::RayBits bits, const hls::WorldBits& world);

/// The fitted core without each cut, the largest first. Cuts that save nothing are not listed.
[[nodiscard]] std::vector<CoreCut> cuts_of(const CoreFit& fit, const CoreFitOptions& options,
                                           const rtl::Library& library);

}  // namespace hitpipe::sim
