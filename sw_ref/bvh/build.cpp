// Top-down construction of the hierarchy of section 4.3, with a list of pending nodes in place of recursion.
// Every pending node is the second child of a branch on the path to the node at work, so the list stays as
// short as the tree is deep. The triangles' boxes are moved along with their indices: each pass over a node
// reads memory in order.
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "sw_ref/bvh/bvh.hpp"

namespace hitpipe::ref {
namespace {

struct Item {
  Aabb box;  ///< of one triangle
  std::uint32_t triangle;
};

struct Pending {
  std::uint32_t node;
  std::uint32_t first, last;  ///< its items: first <= i < last
  int depth;                  ///< level of the node, the root is 1
  int axis;                   ///< tried first
};

void check(const Mesh& mesh, const BuildOptions& options) {
  if (mesh.triangles.empty())
    throw std::invalid_argument("BVH: the mesh has no triangle; at least 1 is needed");
  if (mesh.triangles.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    throw std::invalid_argument("BVH: the mesh has " + std::to_string(mesh.triangles.size()) +
                                " triangles; at most 2147483647 are allowed");
  if (options.max_triangles < 1)
    throw std::invalid_argument("BVH: " + std::to_string(options.max_triangles) +
                                " triangles per leaf; at least 1 is needed");
  if (options.max_depth < 1 || options.max_depth > BuildOptions::deepest)
    throw std::invalid_argument("BVH: a depth of " + std::to_string(options.max_depth) +
                                " levels; allowed are 1 to 60");
  if (!(options.padding >= 0.0F) || !std::isfinite(options.padding) || !(options.min_split >= 0.0F))
    throw std::invalid_argument(
        "BVH: padding and smallest split width must be numbers that are not negative");
}

std::vector<Item> triangle_boxes(const Mesh& mesh) {
  std::vector<Item> items(mesh.triangles.size());
  for (std::uint32_t i = 0; i < items.size(); ++i) {
    const Mesh::Corners corners = mesh.corners(i);
    items[i].triangle = i;
    items[i].box.grow(corners.a);
    items[i].box.grow(corners.b);
    items[i].box.grow(corners.c);
  }
  return items;
}

/// Rounding is monotone and p - padding <= p <= p + padding, so each rounded sum is still on the outer side
/// of p: the result contains `box` whatever the padding.
Aabb padded(const Aabb& box, float padding) {
  return {box.min - padding, box.max + padding};
}

/// Moves the items whose centre along `axis` lies below `pivot` to the front; returns the first of the
/// others.
std::uint32_t partition(std::vector<Item>& items, std::uint32_t first, std::uint32_t last, int axis,
                        float pivot) {
  std::uint32_t middle = first;
  for (std::uint32_t i = first; i < last; ++i) {
    const float centre = (items[i].box.min[axis] + items[i].box.max[axis]) * 0.5F;
    if (centre < pivot) std::swap(items[i], items[middle++]);
  }
  return middle;
}

struct Split {
  std::uint32_t middle;
  int axis;
};

Split split(std::vector<Item>& items, const Pending& at, const Aabb& bounds, float min_split) {
  const glm::vec3 extent = bounds.max - bounds.min;
  for (int tried = 0; tried < 3; ++tried) {
    const int axis = (at.axis + tried) % 3;
    if (extent[axis] < min_split) continue;
    const std::uint32_t middle =
        partition(items, at.first, at.last, axis, bounds.min[axis] + extent[axis] * 0.5F);
    if (middle != at.first && middle != at.last) return {middle, axis};
  }
  return {at.first + (at.last - at.first) / 2, at.axis};
}

}  // namespace

Bvh build_bvh(const Mesh& mesh, const BuildOptions& options) {
  check(mesh, options);
  std::vector<Item> items = triangle_boxes(mesh);
  Bvh bvh;
  bvh.nodes.emplace_back();
  std::vector<Pending> pending{{0, 0, static_cast<std::uint32_t>(items.size()), 1, 0}};
  while (!pending.empty()) {
    const Pending at = pending.back();
    pending.pop_back();
    Aabb bounds;
    for (std::uint32_t i = at.first; i < at.last; ++i) bounds.grow(items[i].box);
    const glm::vec3 extent = bounds.max - bounds.min;
    const std::uint32_t count = at.last - at.first;
    const bool narrow =
        extent.x < options.min_split && extent.y < options.min_split && extent.z < options.min_split;
    BvhNode& node = bvh.nodes[at.node];
    node.box = padded(bounds, options.padding);
    if (narrow || count <= static_cast<std::uint32_t>(options.max_triangles) ||
        at.depth == options.max_depth) {
      node.count = static_cast<std::int32_t>(count);
      node.first = at.first;
      bvh.depth = std::max(bvh.depth, at.depth);
      continue;
    }
    const Split chosen = split(items, at, bounds, options.min_split);
    const auto child = static_cast<std::uint32_t>(bvh.nodes.size());
    node.count = -1 - chosen.axis;
    node.first = child;
    bvh.nodes.resize(bvh.nodes.size() + 2);
    const int next_axis = (chosen.axis + 1) % 3;
    pending.push_back({child + 1, chosen.middle, at.last, at.depth + 1, next_axis});
    pending.push_back({child, at.first, chosen.middle, at.depth + 1, next_axis});
  }
  bvh.order.reserve(items.size());
  for (const Item& item : items) bvh.order.push_back(item.triangle);
  std::vector<Item>().swap(items);
  bvh.nodes.shrink_to_fit();
  return bvh;
}

}  // namespace hitpipe::ref
