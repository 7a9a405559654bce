// Gives a hierarchy the triangles of another mesh, which has some of its triangles in the same order.
#pragma once

#include <cstdint>
#include <span>

#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

/// The branches of `bvh`, with boxes that hold the triangles of `mesh` whole and are not padded. `numbers[i]`
/// is the number in `bvh` of the mesh's triangle i; they ascend. Triangles that have no number here leave
/// their leaves, and a branch with one empty child is replaced by the other one. Throws
/// std::invalid_argument when a triangle of the mesh is in no leaf.
[[nodiscard]] Bvh refitted(const Bvh& bvh, const Mesh& mesh, std::span<const std::uint32_t> numbers);

}  // namespace hitpipe::ref
