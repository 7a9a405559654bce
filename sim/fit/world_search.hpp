// The bits of coordinates with which a core finds what the float world finds, but for few rays.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sim/fit/core_fit.hpp"

namespace hitpipe::sim {

/// "20+1s20".
[[nodiscard]] std::string text_of(const hls::WorldBits& world);

/// Rays of which half the allowed percentage may differ while Wilson's interval ends at it. None for 0 %.
[[nodiscard]] std::optional<std::uint64_t> rays_that_tell(double error_pct);

/// No picture of a comparison has a longer side.
inline constexpr int most_compared_side = 512;

/// All that were compared, one of them taken: the fewest bits of a corner with one finer bit of origins and as many
/// bits of a slope. Then no finer bit, and fewer bits of a slope, if the error allows it. Pictures have as many pixels
/// as rays_that_tell(), in the shape of the options' picture. If the largest has too few, no ray of it may differ.
/// Throws std::runtime_error, one line, when no bits keep to the error.
[[nodiscard]] std::vector<TriedWorld> search_world(const std::vector<ref::Scene>& scenes,
                                                   const CoreFitOptions& options);

}  // namespace hitpipe::sim
