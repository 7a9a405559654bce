// Whether boxes together hold a whole triangle. In a hierarchy with spatial splits each of them holds a part.
#pragma once

#include <span>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

/// The triangle is cut into pieces in double. In the cube the rounding errors stay below this.
constexpr double cover_error = 1e-14;

/// True only if every point of the triangle lies in a box that is grown by `slack` + cover_error on each
/// side.
[[nodiscard]] bool cover(std::span<const Aabb> boxes, const Mesh::Corners& triangle, double slack);

}  // namespace hitpipe::ref
