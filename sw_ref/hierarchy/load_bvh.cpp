// Children of a branch are a range of the file's list of children. A wide branch halves its range, and so do
// the branches made below it, until two are left.
#include "sw_ref/hierarchy/load_bvh.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "sw_ref/hierarchy/bvh_file.hpp"
#include "sw_ref/hierarchy/file_boxes.hpp"
#include "sw_ref/hierarchy/file_tree.hpp"

namespace hitpipe::ref {

namespace {

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

}  // namespace hitpipe::ref
