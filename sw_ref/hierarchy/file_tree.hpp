// Checks that the nodes of a file are a tree, whose boxes hold their children and whose leaves share out the
// list of triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "sw_ref/hierarchy/bvh_file.hpp"

namespace hitpipe::ref {

/// All nodes, each before its children. Every node but the first must be the child of exactly one node, and
/// below the first. Throws as BvhFile::reject() does.
[[nodiscard]] std::vector<std::uint32_t> nodes_from_root(const BvhFile& file);

/// Every entry of the list of triangles must be in exactly one leaf. Throws std::runtime_error, one line.
void check_leaf_ranges(const BvhFile& file);

/// The box of a child must not reach out of its parent's by more than `tolerance`, in the file's space.
/// Leaves without triangles may have any box. Throws as BvhFile::reject() does.
void check_child_boxes(const BvhFile& file, double tolerance);

}  // namespace hitpipe::ref
