// The bounding volume hierarchy of section 4.3: 32-byte nodes, children side by side.
#pragma once

#include <cstdint>
#include <vector>

#include "sw_ref/geometry/aabb.hpp"
#include "sw_ref/scene/mesh.hpp"

namespace hitpipe::ref {

struct BvhNode {
  Aabb box;             ///< padded outward by BuildOptions::padding
  std::int32_t count;   ///< >= 1: triangles of a leaf; -1, -2, -3: branch split along x, y, z
  std::uint32_t first;  ///< leaf: first entry of Bvh::order; branch: index of child 0, child 1 follows it

  [[nodiscard]] bool is_leaf() const { return count > 0; }
  [[nodiscard]] int split_axis() const { return -1 - count; }
};
static_assert(sizeof(BvhNode) == 32, "the thesis's node is 32 bytes (Table 5.1)");

struct BuildOptions {
  static constexpr int deepest = 60;  ///< section 4.3; a traversal's stack is sized by it

  int max_triangles = 6;    ///< of a leaf, >= 1; section 4.3
  int max_depth = deepest;  ///< levels, 1..deepest, the root is level 1
  float padding = 5e-7F;    ///< >= 0, added to each side of a box, in units of the [-1, 1] cube
  float min_split = 1e-6F;  ///< >= 0, an axis along which the unpadded box is narrower is not split
};

struct Bvh {
  std::vector<BvhNode> nodes;        ///< nodes[0] is the root
  std::vector<std::uint32_t> order;  ///< triangle indices, leaf by leaf
  int depth = 0;                     ///< levels of the deepest leaf
};

/// Builds top down: round-robin axis, spatial midpoint, the empty-child strategy of section 4.3. Child 0 of a
/// branch lies on the negative side of its split axis, except where no axis separates the triangles and the
/// list is halved. The same mesh gives the same hierarchy, node for node. Throws std::invalid_argument when
/// the mesh has no triangle, or more than 2^31 - 1, or an option is out of range.
[[nodiscard]] Bvh build_bvh(const Mesh& mesh, const BuildOptions& options = {});

}  // namespace hitpipe::ref
