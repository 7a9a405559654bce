#include "sw_ref/hierarchy/file_tree.hpp"

#include <algorithm>
#include <span>

#include <fmt/format.h>

#include "sw_ref/reject.hpp"

namespace hitpipe::ref {

namespace {

constexpr std::uint32_t no_parent = ~0U;

std::span<const std::uint32_t> children_of(const BvhFile& file, const FileNode& node) {
  if (node.is_leaf) return {};
  return std::span(file.children).subspan(node.first, node.count);
}

std::vector<std::uint32_t> parents(const BvhFile& file) {
  std::vector<std::uint32_t> parent(file.nodes.size(), no_parent);
  for (const FileNode& node : file.nodes) {
    for (const std::uint32_t child : children_of(file, node)) {
      if (child == 0) file.reject(node, "has the root, node 0, as a child; that is a cycle");
      if (parent[child] != no_parent)
        file.reject(file.nodes[child],
                    fmt::format("is a child of node {} and of node {}; it must be the child of one node",
                                parent[child], file.number(node)));
      parent[child] = file.number(node);
    }
  }
  return parent;
}

/// A node that is not below the root has no parent, or the nodes above it are a cycle.
[[noreturn]] void reject_lost(const BvhFile& file, const std::vector<std::uint32_t>& parent,
                              const std::vector<bool>& found) {
  const auto without = std::find(parent.begin() + 1, parent.end(), no_parent);
  if (without != parent.end())
    file.reject(file.nodes[static_cast<std::size_t>(without - parent.begin())],
                "is the child of no node; only the root, node 0, may be");
  const auto lost = static_cast<std::uint32_t>(std::find(found.begin(), found.end(), false) - found.begin());
  std::vector<bool> seen(parent.size());
  std::uint32_t node = lost;
  for (; !seen[node]; node = parent[node]) seen[node] = true;
  file.reject(file.nodes[node], "is below itself; that is a cycle");
}

}  // namespace

std::vector<std::uint32_t> nodes_from_root(const BvhFile& file) {
  const std::vector<std::uint32_t> parent = parents(file);
  std::vector<bool> found(file.nodes.size());
  std::vector<std::uint32_t> nodes{0};
  nodes.reserve(file.nodes.size());
  found[0] = true;
  // Every node has one parent, so none is met twice.
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    for (const std::uint32_t child : children_of(file, file.nodes[nodes[i]])) {
      found[child] = true;
      nodes.push_back(child);
    }
  }
  if (nodes.size() < file.nodes.size()) reject_lost(file, parent, found);
  return nodes;
}

void check_leaf_ranges(const BvhFile& file) {
  std::vector<bool> taken(file.triangles.size());
  std::size_t total = 0;
  for (const FileNode& node : file.nodes) {
    if (!node.is_leaf) continue;
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (taken[i])
        file.reject(node, fmt::format("takes entry {} of the list of triangles, which another leaf takes; "
                                      "list a triangle twice if two leaves have it",
                                      i));
      taken[i] = true;
    }
    total += node.count;
  }
  if (total == taken.size()) return;
  const auto left = std::find(taken.begin(), taken.end(), false) - taken.begin();
  reject(of_bvh_file(file.path, fmt::format("no leaf takes entry {} of the list of triangles", left)));
}

void check_child_boxes(const BvhFile& file, double tolerance) {
  for (const FileNode& node : file.nodes) {
    for (const std::uint32_t number : children_of(file, node)) {
      const FileNode& child = file.nodes[number];
      if (child.is_leaf && child.count == 0) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const auto check = [&](const char* side, float inner, float outer, double out_by) {
          if (out_by <= tolerance) return;
          file.reject(child, fmt::format("reaches out of its parent, node {}: {}.{} {}, of the parent {}",
                                         file.number(node), side, "xyz"[axis], inner, outer));
        };
        const float low = child.box.min[axis];
        const float high = child.box.max[axis];
        check("min", low, node.box.min[axis], double{node.box.min[axis]} - low);
        check("max", high, node.box.max[axis], double{high} - node.box.max[axis]);
      }
    }
  }
}

}  // namespace hitpipe::ref
