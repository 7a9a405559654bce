// Cuts ears off a polygon of the plane until nothing is left (Meisters 1975).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>

namespace hitpipe::ref {

/// Adds corners - 2 triangles, each turning left or without area, as places in `corners`, in the order of the
/// polygon. Their areas add up to the polygon's, because the area of what is left changes by the triangle's
/// at each cut. `corners` has winding() left or none. False if there is no such cut: then the polygon crosses
/// itself in a corner.
[[nodiscard]] bool cut_ears(std::span<const glm::dvec2> corners,
                            std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace hitpipe::ref
