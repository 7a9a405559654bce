// The boxes of a hierarchy over an integer mesh.
#pragma once

#include <span>
#include <vector>

#include "rays/tree/bvh.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_mesh.hpp"

namespace hitpipe::ref {

/// By node of the hierarchy: the smallest box of all corners below. A node without triangles is not in a
/// hierarchy.
[[nodiscard]] std::vector<IntBox> int_boxes(std::span<const IntTriangle> triangles, const Bvh& bvh);

}  // namespace hitpipe::ref
