// Hierarchies for nodes whose leaves count only a few triangles.
#pragma once

#include <cstdint>

#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

/// A leaf with more than `most` triangles, >= 1, is halved until none is left. The halves keep the leaf's
/// box, so no box grows and none is too small. The order of the triangles stays.
[[nodiscard]] Bvh small_leaves(const Bvh& bvh, int most);

/// A branch above at most `most` triangles becomes a leaf, where those are tested together. Nodes below it
/// stay, and nothing leads to them.
[[nodiscard]] Bvh joined_leaves(const Bvh& bvh, int most);

/// What is below the node, as a hierarchy.
[[nodiscard]] Bvh below(const Bvh& bvh, std::uint32_t node);

}  // namespace hitpipe::ref
