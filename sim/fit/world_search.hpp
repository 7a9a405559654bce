// The bits of coordinates with which a core finds what the float world finds, but for few rays.
#pragma once

#include <string>
#include <vector>

#include "sim/fit/core_fit.hpp"

namespace hitpipe::sim {

/// "20+1s20".
[[nodiscard]] std::string text_of(const hls::WorldBits& world);

/// All that were compared, one of them taken: the fewest bits of a corner with one finer bit of origins and as many bits
/// of a slope. Then no finer bit, and fewer bits of a slope, if the error allows it. Throws std::runtime_error, one line,
/// when no bits keep to the error.
[[nodiscard]] std::vector<TriedWorld> search_world(const std::vector<ref::Scene>& scenes,
                                                   const CoreFitOptions& options);

}  // namespace hitpipe::sim
