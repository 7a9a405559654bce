// The bounding volume hierarchy of section 4.3: 32-byte nodes; the two children of a branch are neighbours.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/mesh.hpp"

namespace hitpipe::ref {

struct BvhNode {
  Aabb box;             ///< padded outward by BuildOptions::padding
  std::int32_t count;   ///< >= 1: triangles of a leaf; -1, -2, -3: branch split along x, y, z
  std::uint32_t first;  ///< leaf: first entry of Bvh::order; branch: index of child 0, child 1 follows it

  [[nodiscard]] bool is_leaf() const { return count > 0; }
  [[nodiscard]] int split_axis() const { return -1 - count; }
};
static_assert(sizeof(BvhNode) == 32, "the thesis's node is 32 bytes (Table 5.1)");

/// Where a branch is split.
enum class Builder : std::uint8_t {
  median,  ///< section 4.3: in the middle of its box, the axes in turn; the next axis if a child would be
           ///< empty
  sah,     ///< where the surface area heuristic finds it cheapest, in bins (Wald 2007)
};

/// "median" or "sah".
[[nodiscard]] std::string_view builder_name(Builder builder);

struct BuildOptions {
  static constexpr int deepest = 60;  ///< section 4.3; it sets the size of a traversal's stack

  Builder builder = Builder::median;
  int max_triangles = 6;    ///< of a leaf, >= 1; section 4.3. sah makes smaller leaves where they are cheaper
  int max_depth = deepest;  ///< levels, 1..deepest, the root is level 1
  float padding = 5e-7F;    ///< >= 0, added to each side of a box, in units of the [-1, 1] cube
  float min_split = 1e-6F;  ///< >= 0; the unpadded box is not split along an axis where it is narrower
  int grid_bits = 0;  ///< n, 6..32: nor where it is narrower than a unit of the n-bit grid (section 6.1)
  int threads = 0;    ///< >= 1, 0: one a core; no bit of the hierarchy depends on it
};

/// What today's tracers build: surface areas, and two triangles a leaf, with which time and bytes of a ray
/// are least on most scenes (docs/choosing.md). The default of what compares units, and of a core's image.
inline constexpr BuildOptions surface_area_build{.builder = Builder::sah, .max_triangles = 2};

struct Bvh {
  std::vector<BvhNode> nodes;        ///< nodes[0] is the root; pairs of children follow in depth-first order:
                                     ///< the branch first, then child 0, then child 1
  std::vector<std::uint32_t> order;  ///< triangle indices, leaf by leaf
  int depth = 0;                     ///< levels of the deepest leaf
};

/// Builds top down. Child 0 of a branch lies on the negative side of its split axis, unless no axis separates
/// the triangles and the list is halved. A node that is too narrow along all axes is a leaf, however many
/// triangles it has. The same mesh gives the same hierarchy, bit for bit. Throws std::invalid_argument when
/// the mesh has no triangle, or more than 2^31 - 1, or an option is out of range.
[[nodiscard]] Bvh build_bvh(const Mesh& mesh, const BuildOptions& options = {});

// The surface area heuristic (MacDonald and Booth 1990): the work for a random line that meets the root. The
// probability that a line through a convex box meets a box inside it is the ratio of their surface areas.

/// The costs of visiting a branch, which is two box tests, and of testing one triangle of a leaf. They are
/// equal because the measured times are about equal in hierarchies of 1 to 16 triangles per leaf
/// (docs/scenes.md): 13 to 15 ns a branch, 11 to 13 ns a triangle.
constexpr float traversal_cost = 1.0F;
constexpr float intersection_cost = 1.0F;

/// Half the surface of a box that is not empty.
template <class T>
[[nodiscard]] T half_area(const BasicAabb<T>& box) {
  const glm::vec<3, T> extent = box.max - box.min;
  return extent.x * extent.y + extent.y * extent.z + extent.z * extent.x;
}

}  // namespace hitpipe::ref
