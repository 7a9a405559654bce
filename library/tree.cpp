// A caller's hierarchy, checked.
#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "library/failure.hpp"
#include "library/scene.hpp"

namespace hitpipe::library {

namespace {

[[noreturn]] void bad_node(std::size_t node, const std::string& why) {
  throw Refusal(HITPIPE_BAD_HIERARCHY, fmt::format("node {}: {}", node, why));
}

}  // namespace

ref::Bvh checked_tree(const hitpipe_hierarchy& hierarchy, std::size_t triangles) {
  const std::size_t count = hierarchy.node_count;
  const hitpipe_node* const nodes = &given(hierarchy.nodes, "nodes of the hierarchy");
  const std::uint32_t* const order = &given(hierarchy.order, "order of the hierarchy");
  if (count == 0) throw Refusal(HITPIPE_BAD_HIERARCHY, "the hierarchy has no node; it needs a root");
  ref::Bvh tree;
  tree.order.assign(order, order + triangles);
  std::vector<bool> listed(triangles);
  for (const std::uint32_t triangle : tree.order) {
    if (triangle >= triangles || listed[triangle])
      throw Refusal(
          HITPIPE_BAD_HIERARCHY,
          fmt::format("order of the hierarchy: triangle {} is {}; each of the {} comes once", triangle,
                      triangle >= triangles ? "not in the mesh" : "there twice", triangles));
    listed[triangle] = true;
  }
  std::vector<int> levels(count);  // 0: not reached
  levels[0] = 1;
  std::size_t in_leaves = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const hitpipe_node& node = nodes[i];
    if (levels[i] == 0) bad_node(i, "no branch before it has it as a child");
    if (levels[i] > ref::BuildOptions::deepest)
      bad_node(i, fmt::format("it is deeper than {} levels", ref::BuildOptions::deepest));
    tree.depth = std::max(tree.depth, levels[i]);
    if (node.count < 0) bad_node(i, fmt::format("a leaf of {} triangles", node.count));
    if (node.count > 0) {
      const auto leaf = static_cast<std::size_t>(node.count);
      if (node.first > triangles || leaf > triangles - node.first)
        bad_node(i, fmt::format("places {} to {} of an order of {}", node.first, node.first + leaf - 1,
                                triangles));
      in_leaves += leaf;
      tree.nodes.push_back({.box = {}, .count = node.count, .first = node.first});
      continue;
    }
    if (node.first <= i || std::size_t{node.first} + 1 >= count)
      bad_node(i, fmt::format("children {} and {}; they come after it and are below {}", node.first,
                              std::size_t{node.first} + 1, count));
    for (std::size_t child = node.first; child < std::size_t{node.first} + 2; ++child) {
      if (levels[child] != 0) bad_node(child, "two branches have it as a child");
      levels[child] = levels[i] + 1;
    }
    tree.nodes.push_back({.box = {}, .count = -1, .first = node.first});
  }
  std::vector<bool> held(triangles);
  for (std::size_t i = 0; i < count; ++i) {
    const ref::BvhNode& node = tree.nodes[i];
    if (!node.is_leaf()) continue;
    for (std::size_t at = node.first; at < node.first + static_cast<std::size_t>(node.count); ++at) {
      if (held[at]) bad_node(i, fmt::format("place {} of the order is in another leaf, too", at));
      held[at] = true;
    }
  }
  if (in_leaves != triangles)
    throw Refusal(HITPIPE_BAD_HIERARCHY,
                  fmt::format("the leaves have {} triangles of {}", in_leaves, triangles));
  return tree;
}

}  // namespace hitpipe::library
