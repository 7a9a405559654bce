// How often a closed walk in the plane covers the points of the plane.
#pragma once

#include <span>

#include <glm/vec2.hpp>

namespace hitpipe::ref {

/// left: each point is covered once or not at all, and lies left of the walk. right: the same, right of it.
/// none: no area is covered. crossing: edges cross, or some points are covered twice. crowded: nobody
/// counted, because too many edges lie over one another.
enum class Winding { left, right, none, crossing, crowded };

/// Edges that may run through one corner.
inline constexpr int most_through_corner = 256;

/// Exact, in n log n, and n for each edge that lies over others. The walk may touch itself and walk an edge
/// twice. Coordinates as orientation() says.
[[nodiscard]] Winding winding(std::span<const glm::dvec2> corners);

}  // namespace hitpipe::ref
