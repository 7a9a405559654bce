// A room is a mesh whose triangles cover its own bounding box. From outside it looks like a closed box, so
// its camera must be inside.
#pragma once

#include <optional>

#include "sw_ref/scene/mesh.hpp"
#include "sw_ref/scene/normalise.hpp"

namespace hitpipe::ref {

/// The bounds of the room's contents; nothing if the mesh is not a room or the room is empty. In a room the
/// triangles in each of the six planes of the bounding box have a total area of at least 99 % of that side.
[[nodiscard]] std::optional<Bounds> room_contents(const Mesh& mesh, const Bounds& walls);

}  // namespace hitpipe::ref
