#include "rays/tree/load_bvh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "rays/tree/bvh_file.hpp"
#include "rays/tree/file_boxes.hpp"

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

/// All nodes, each before its children. Every node but the first must be the child of exactly one node, and
/// below the first.
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

/// Every entry of the list of triangles must be in exactly one leaf.
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

/// The box of a child must not reach out of its parent's by more than `tolerance`, in the file's space.
/// Leaves without triangles may have any box.
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

class BinaryTree {
 public:
  BinaryTree(BvhFile& file, float padding) : file_(file), padding_(padding) {}

  Bvh make() {
    bvh_.nodes.reserve(file_.nodes.size());
    bvh_.order.reserve(file_.triangles.size());
    bvh_.nodes.emplace_back();
    // The root is the one child of a range, as every other node is.
    const auto root = static_cast<std::uint32_t>(file_.children.size());
    file_.children.push_back(0);
    visit({root, root + 1, 0, 1});
    while (!pending_.empty()) {
      const Pending at = pending_.back();
      pending_.pop_back();
      visit(at);
    }
    return std::move(bvh_);
  }

 private:
  /// A node to be made of the children [first, last) of the file.
  struct Pending {
    std::uint32_t first, last;
    std::uint32_t place;  ///< its index in the result
    int depth;            ///< its level; the root is 1
  };
  struct Division {
    std::uint32_t middle;
    int axis;
  };

  FileNode& node_of(std::uint32_t child) { return file_.nodes[file_.children[child]]; }

  void visit(Pending at) {
    std::int8_t stated = FileNode::no_split;
    Aabb box = node_of(at.first).box;
    const FileNode* node = &node_of(at.first);
    if (at.depth > BuildOptions::deepest)
      file_.reject(*node, fmt::format("is on level {}, where branches have two children; at most {} levels "
                                      "are allowed",
                                      at.depth, BuildOptions::deepest));
    if (at.last - at.first == 1) {
      while (!node->is_leaf && node->count == 1) node = &node_of(node->first);
      box = node->box;
      if (node->is_leaf) {
        put_leaf(at, *node);
        return;
      }
      stated = node->split;
      at.first = node->first;
      at.last = node->first + node->count;
    } else {
      for (std::uint32_t child = at.first; child < at.last; ++child) box.grow(node_of(child).box);
    }
    const Division division = stated == FileNode::no_split ? divide(at) : Division{at.first + 1, int{stated}};
    const auto child_0 = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes[at.place] = {padded(box), -1 - division.axis, child_0};
    bvh_.nodes.resize(bvh_.nodes.size() + 2);
    pending_.push_back({division.middle, at.last, child_0 + 1, at.depth + 1});
    pending_.push_back({at.first, division.middle, child_0, at.depth + 1});
  }

  void put_leaf(const Pending& at, const FileNode& leaf) {
    bvh_.depth = std::max(bvh_.depth, at.depth);
    bvh_.nodes[at.place] = {padded(leaf.box), static_cast<std::int32_t>(leaf.count),
                            static_cast<std::uint32_t>(bvh_.order.size())};
    const auto first = file_.triangles.begin() + static_cast<std::ptrdiff_t>(leaf.first);
    bvh_.order.insert(bvh_.order.end(), first, first + static_cast<std::ptrdiff_t>(leaf.count));
  }

  /// Sorts children by the centres of their boxes, along the axis along which these lie farthest apart.
  Division divide(const Pending& at) {
    Aabb centres;
    for (std::uint32_t child = at.first; child < at.last; ++child) centres.grow(centre(node_of(child)));
    const glm::vec3 spread = centres.max - centres.min;
    int axis = 0;
    for (const int other : {1, 2})
      if (spread[other] > spread[axis]) axis = other;
    const auto begin = file_.children.begin();
    std::stable_sort(begin + static_cast<std::ptrdiff_t>(at.first),
                     begin + static_cast<std::ptrdiff_t>(at.last), [&](std::uint32_t a, std::uint32_t b) {
                       return centre(file_.nodes[a])[axis] < centre(file_.nodes[b])[axis];
                     });
    return {at.first + (at.last - at.first + 1) / 2, axis};
  }

  static glm::vec3 centre(const FileNode& node) { return (node.box.min + node.box.max) * 0.5F; }

  /// As build_bvh() pads.
  [[nodiscard]] Aabb padded(const Aabb& box) const { return {box.min - padding_, box.max + padding_}; }

  BvhFile& file_;
  float padding_;
  Bvh bvh_;
  std::vector<Pending> pending_;
};

}  // namespace

LoadedBvh load_bvh(const std::filesystem::path& path, const Scene& scene, float padding) {
  BvhFile file = read_bvh_file(path);
  const std::vector<std::uint32_t> from_root = nodes_from_root(file);
  check_leaf_ranges(file);
  const double tolerance = box_tolerance(file, scene);
  check_child_boxes(file, tolerance);
  move_into_cube(file, scene);
  LoadedBvh loaded;
  loaded.boxes_grown = fit_to_triangles(file, scene, tolerance * scene.to_cube.scale, from_root);
  loaded.bvh = BinaryTree(file, file.space == FileSpace::cube ? 0.0F : padding).make();
  return loaded;
}

std::string HierarchyOptions::name() const {
  if (!file.empty()) return file.filename().string();
  return fmt::format("{} {}", builder_name(build.builder), build.max_triangles);
}

std::string HierarchyOptions::text() const {
  if (!file.empty()) return fmt::format("hierarchy of {}", file.filename().string());
  return fmt::format("{}, at most {} triangle{} a leaf",
                     build.builder == Builder::sah ? "surface-area tree" : "median split",
                     build.max_triangles, build.max_triangles == 1 ? "" : "s");
}

LoadedBvh make_hierarchy(const Scene& scene, const HierarchyOptions& options) {
  if (options.file.empty()) return {build_bvh(scene.mesh, options.build)};
  return load_bvh(options.file, scene, options.build.padding);
}

}  // namespace hitpipe::ref
