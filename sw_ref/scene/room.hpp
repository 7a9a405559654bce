// A mesh that its own bounding box encloses: seen from outside it is a closed box, so its camera belongs
// inside.
#pragma once

#include <optional>

#include "sw_ref/scene/mesh.hpp"
#include "sw_ref/scene/normalise.hpp"

namespace hitpipe::ref {

/// The bounds of what stands in the room; nothing when the mesh is no room or the room is empty. A room has
/// triangles that lie in each of the six planes of the bounding box whose areas add up to at least 99 % of
/// that side.
[[nodiscard]] std::optional<Bounds> room_contents(const Mesh& mesh, const Bounds& walls);

}  // namespace hitpipe::ref
