// A polygon of a mesh file as triangles, exactly.
//
// What a polygon is: its corners are seen along the axis that its plane's normal (Newell's) is nearest to.
// There the closed walk along the corners covers each point once or not at all. It may touch itself, also
// along an edge: so a hole is joined to the outline by an edge that is walked twice. A polygon that crosses
// itself, or covers points twice, is refused. Files round coordinates, and real models have faces that are a
// little bent. Such a face is taken if no corner is farther from the plane through the corners' mean than a
// quarter of the extent (the diagonal of the box around the polygon). A face with a corner farther off says
// nothing about its surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include <glm/vec3.hpp>

namespace hitpipe::ref {

/// Farthest that a corner may be from its polygon's plane, in parts of the polygon's extent.
inline constexpr double most_off_plane = 0.25;

/// Adds corners - 2 triangles of places in `positions`, in the order of the polygon; some may have no area.
/// Seen along the axis, they turn as the polygon does, and their areas add up to its area: both exactly. A
/// polygon with all corners on a line gives triangles without area; less than 3 corners give none. Positions
/// are finite. A coordinate below 2^-480 counts as 0 beside one of 2^-100 and more. Returns what is wrong
/// with the polygon, as the end of a sentence that begins with its name; empty if nothing
/// is, and only then triangles were added. Time is near n log n; with
/// many long cuts, as in a star of 10^5 points and more, it grows with n^2.
[[nodiscard]] std::string triangulate(std::span<const glm::dvec3> positions,
                                      std::span<const std::uint32_t> polygon,
                                      std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace hitpipe::ref
