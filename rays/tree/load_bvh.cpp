#include "rays/tree/load_bvh.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "rays/scene/triangle_numbers.hpp"
#include "rays/tree/bvh_file.hpp"
#include "rays/tree/triangle_cover.hpp"

namespace hitpipe::ref {

namespace {

bool is_empty_leaf(const FileNode& node) {
  return node.is_leaf && node.count == 0;
}

/// The box of a child must not reach out of its parent's by more than `tolerance`, in the file's space.
/// Leaves without triangles may have any box.
void check_child_boxes(BvhFile& file, double tolerance) {
  for (const FileNode& node : file.nodes) {
    if (node.is_leaf) continue;
    for (const std::uint32_t number : file.entries(node)) {
      const FileNode& child = file.nodes[number];
      if (is_empty_leaf(child)) continue;
      for (int axis = 0; axis < 3; ++axis) {
        const auto check = [&](const char* side, float inner, float outer, double out_by) {
          if (out_by <= tolerance) return;
          file.reject(child, "reaches out of its parent, node {}: {}.{} {}, of the parent {}",
                      file.number(node), side, "xyz"[axis], inner, outer);
        };
        const float low = child.box.min[axis];
        const float high = child.box.max[axis];
        check("min", low, node.box.min[axis], double{node.box.min[axis]} - low);
        check("max", high, node.box.max[axis], double{high} - node.box.max[axis]);
      }
    }
  }
}

/// By how much a box may be too small, in the file's space. Two programs that read a coordinate from text may
/// round it differently. So it is four units in the last place of the mesh's largest coordinate, and 0 in
/// the cube.
double box_tolerance(const BvhFile& file, const Scene& scene) {
  if (file.space == FileSpace::cube) return 0.0;
  Aabb mesh;
  for (const glm::vec3& vertex : scene.mesh.vertices) mesh.grow(vertex);
  double largest = 0.0;
  for (const glm::vec3& corner : {mesh.min, mesh.max}) {
    const glm::dvec3 own = glm::abs(scene.to_cube.to_own(glm::dvec3(corner)));
    largest = std::max({largest, own.x, own.y, own.z});
  }
  constexpr double four_units = 0x1p-21;  // of binary32, relative to the lower end of a binade
  return four_units * largest;
}

float rounded_down(double x) {
  const auto nearest = static_cast<float>(x);
  return double{nearest} <= x ? nearest : std::nextafter(nearest, -std::numeric_limits<float>::infinity());
}

Aabb rounded_outward(const glm::dvec3& min, const glm::dvec3& max) {
  Aabb box;
  for (int axis = 0; axis < 3; ++axis) {
    box.min[axis] = rounded_down(min[axis]);
    box.max[axis] = -rounded_down(-max[axis]);
  }
  return box;
}

/// Moves every box as the scene's points are moved, rounds it outward to binary32, and cuts it to the part of
/// the cube in which the mesh lies. Boxes of the cube are taken as they are.
void move_into_cube(BvhFile& file, const Scene& scene) {
  for (FileNode& node : file.nodes) {
    if (is_empty_leaf(node)) continue;
    if (file.space == FileSpace::scene) {
      constexpr auto bound = static_cast<float>(cube_bound);
      const Aabb box = rounded_outward(scene.to_cube.to_cube(glm::dvec3(node.box.min)),
                                       scene.to_cube.to_cube(glm::dvec3(node.box.max)));
      node.box = {glm::clamp(box.min, -bound, bound), glm::clamp(box.max, -bound, bound)};
      continue;
    }
    for (int axis = 0; axis < 3; ++axis) {
      if (node.box.min[axis] >= -1.0F && node.box.max[axis] <= 1.0F) continue;
      file.reject(node, "reaches from {} to {} along {}; boxes of space cube must lie within -1 and 1",
                  node.box.min[axis], node.box.max[axis], "xyz"[axis]);
    }
  }
}

/// Replaces the file's numbers of triangles by the mesh's, leaves out dropped triangles, and then takes
/// leaves without triangles out of their branches. Boxes that are too small by at most `tolerance`, in the
/// cube, are grown. A triangle may stick out of its leaf if all its leaves together hold it.
class Fit {
 public:
  Fit(BvhFile& file, const Scene& scene, double tolerance)
      : file_(file),
        scene_(scene),
        numbers_(scene.mesh),
        tolerance_(tolerance),
        seen_(scene.mesh.triangles.size()),
        grown_(file.nodes.size()) {}

  /// Returns how many boxes were grown.
  std::size_t run() {
    for (FileNode& node : file_.nodes)
      if (node.is_leaf) take_triangles(node);
    const auto missing = std::find(seen_.begin(), seen_.end(), false);
    if (missing != seen_.end())
      file_.reject(fmt::format("triangle {} is in no leaf",
                               numbers_.of_source(static_cast<std::uint32_t>(missing - seen_.begin()))));
    if (!parted_.empty()) check_parted();
    for (auto number = file_.from_root.rbegin(); number != file_.from_root.rend(); ++number)
      if (!file_.nodes[*number].is_leaf) take_children(file_.nodes[*number]);
    return static_cast<std::size_t>(std::count(grown_.begin(), grown_.end(), true));
  }

 private:
  void set_box(FileNode& node, const Aabb& box) {
    if (box.min == node.box.min && box.max == node.box.max) return;
    grown_[file_.number(node)] = true;
    node.box = box;
  }

  [[nodiscard]] Aabb bounds(std::uint32_t triangle) const {
    const Mesh::Corners corners = scene_.mesh.corners(triangle);
    Aabb box;
    for (const glm::vec3& corner : {corners.a, corners.b, corners.c}) box.grow(corner);
    return box;
  }

  /// Each face that is short of the triangle by at most the tolerance is moved to it.
  [[nodiscard]] Aabb stretched(Aabb box, const Aabb& triangle) const {
    for (int axis = 0; axis < 3; ++axis) {
      const float low = triangle.min[axis];
      const float high = triangle.max[axis];
      if (low < box.min[axis] && double{box.min[axis]} - low <= tolerance_) box.min[axis] = low;
      if (high > box.max[axis] && double{high} - box.max[axis] <= tolerance_) box.max[axis] = high;
    }
    return box;
  }

  void take_triangles(FileNode& leaf) {
    const std::span<std::uint32_t> entries = file_.entries(leaf);
    leaf.count = 0;
    for (const std::uint32_t source : entries) {
      if (source >= numbers_.in_source())
        file_.reject(leaf, "has triangle {}; the scene's are 0 to {}", source, numbers_.in_source() - 1);
      const std::uint32_t triangle = numbers_.in_mesh(source);
      if (triangle == TriangleNumbers::none) continue;
      entries[leaf.count++] = triangle;
      seen_[triangle] = true;
      const Aabb needed = bounds(triangle);
      set_box(leaf, stretched(leaf.box, needed));
      if (!encloses(leaf.box, needed)) parted_[triangle];
    }
  }

  /// Boxes that hold parts of triangles are grown by the tolerance, because their faces may have been
  /// computed where an edge meets a plane.
  void check_parted() {
    for (const FileNode& node : file_.nodes) {
      if (!node.is_leaf) continue;
      for (const std::uint32_t triangle : file_.entries(node))
        if (const auto found = parted_.find(triangle); found != parted_.end())
          found->second.push_back(file_.number(node));
    }
    const bool may_grow = tolerance_ > 0.0;
    std::set<std::uint32_t> all_leaves;
    for (const auto& [triangle, leaves] : parted_) {
      std::vector<Aabb> boxes;
      for (const std::uint32_t leaf : leaves) boxes.push_back(file_.nodes[leaf].box);
      if (!cover(boxes, scene_.mesh.corners(triangle), may_grow ? tolerance_ : -cover_error))
        reject_uncovered(triangle, leaves);
      all_leaves.insert(leaves.begin(), leaves.end());
    }
    if (!may_grow) return;
    const double more = tolerance_ + cover_error;
    for (const std::uint32_t number : all_leaves) {
      FileNode& leaf = file_.nodes[number];
      set_box(leaf, rounded_outward(glm::dvec3(leaf.box.min) - more, glm::dvec3(leaf.box.max) + more));
    }
  }

  [[noreturn]] void reject_uncovered(std::uint32_t triangle, const std::vector<std::uint32_t>& leaves) const {
    const Aabb needed = bounds(triangle);
    const FileNode& leaf = file_.nodes[*std::find_if(leaves.begin(), leaves.end(), [&](std::uint32_t number) {
      return !encloses(file_.nodes[number].box, needed);
    })];
    int axis = 0;
    while (leaf.box.min[axis] <= needed.min[axis] && needed.max[axis] <= leaf.box.max[axis]) ++axis;
    const bool is_min = needed.min[axis] < leaf.box.min[axis];
    const auto own = [&](const Aabb& box) {
      const float x = is_min ? box.min[axis] : box.max[axis];
      return file_.space == FileSpace::cube ? double{x} : scene_.to_cube.to_own(glm::dvec3(x))[axis];
    };
    file_.reject(leaf, "does not hold triangle {}{}: {}.{} of the triangle is {:.7g}, of the box {:.7g}",
                 numbers_.of_source(triangle),
                 leaves.size() == 1 ? "" : ", and its other leaves do not hold the rest",
                 is_min ? "min" : "max", "xyz"[axis], own(needed), own(leaf.box));
  }

  void take_children(FileNode& branch) {
    const std::span<std::uint32_t> children = file_.entries(branch);
    Aabb box = branch.box;
    branch.count = 0;
    for (const std::uint32_t number : children) {
      const FileNode& child = file_.nodes[number];
      if (child.count == 0) continue;
      children[branch.count++] = number;
      box.grow(child.box);
    }
    if (branch.count > 0) set_box(branch, box);
  }

  BvhFile& file_;
  const Scene& scene_;
  TriangleNumbers numbers_;
  double tolerance_;
  std::vector<bool> seen_;   // by triangle of the mesh
  std::vector<bool> grown_;  // by node
  /// Triangles that stick out of a leaf: all their leaves.
  std::map<std::uint32_t, std::vector<std::uint32_t>> parted_;
};

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
    pending_.push_back({root, root + 1, 0, 1});
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

  FileNode& node_of(std::uint32_t child) { return file_.nodes[file_.children[child]]; }

  void visit(Pending at) {
    const FileNode* node = &node_of(at.first);
    if (at.depth > BuildOptions::deepest)
      file_.reject(*node, "is on level {}, where branches have two children; at most {} levels are allowed",
                   at.depth, BuildOptions::deepest);
    Aabb box;
    int axis = FileNode::no_split;
    if (at.last - at.first == 1) {
      while (!node->is_leaf && node->count == 1) node = &node_of(node->first);
      if (node->is_leaf) {
        put_leaf(at, *node);
        return;
      }
      box = node->box;
      axis = node->split;
      at.first = node->first;
      at.last = node->first + node->count;
    } else {
      for (std::uint32_t child = at.first; child < at.last; ++child) box.grow(node_of(child).box);
    }
    if (axis == FileNode::no_split) axis = sort(at);
    const std::uint32_t middle = at.first + (at.last - at.first + 1) / 2;
    const auto child_0 = static_cast<std::uint32_t>(bvh_.nodes.size());
    bvh_.nodes[at.place] = {padded(box), -1 - axis, child_0};
    bvh_.nodes.resize(bvh_.nodes.size() + 2);
    pending_.push_back({middle, at.last, child_0 + 1, at.depth + 1});
    pending_.push_back({at.first, middle, child_0, at.depth + 1});
  }

  void put_leaf(const Pending& at, const FileNode& leaf) {
    bvh_.depth = std::max(bvh_.depth, at.depth);
    bvh_.nodes[at.place] = {padded(leaf.box), static_cast<std::int32_t>(leaf.count),
                            static_cast<std::uint32_t>(bvh_.order.size())};
    const std::span<const std::uint32_t> triangles = file_.entries(leaf);
    bvh_.order.insert(bvh_.order.end(), triangles.begin(), triangles.end());
  }

  /// Sorts children by the centres of their boxes, along the axis along which these lie farthest apart; returns it.
  int sort(const Pending& at) {
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
    return axis;
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
  const double tolerance = box_tolerance(file, scene);
  check_child_boxes(file, tolerance);
  move_into_cube(file, scene);
  LoadedBvh loaded;
  loaded.boxes_grown = Fit(file, scene, tolerance * scene.to_cube.scale).run();
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
