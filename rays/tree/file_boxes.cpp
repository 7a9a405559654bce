#include "rays/tree/file_boxes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/reject.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/tree/triangle_cover.hpp"

namespace hitpipe::ref {

namespace {

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

bool equal(const Aabb& a, const Aabb& b) {
  return a.min == b.min && a.max == b.max;
}

bool is_empty_leaf(const FileNode& node) {
  return node.is_leaf && node.count == 0;
}

class Fit {
 public:
  Fit(BvhFile& file, const Scene& scene, double tolerance)
      : file_(file),
        scene_(scene),
        numbers_(scene.mesh),
        tolerance_(tolerance),
        seen_(scene.mesh.triangles.size()),
        grown_(file.nodes.size()) {}

  std::size_t run(std::span<const std::uint32_t> from_root) {
    for (FileNode& node : file_.nodes)
      if (node.is_leaf) take_triangles(node);
    const auto missing = std::find(seen_.begin(), seen_.end(), false) - seen_.begin();
    if (static_cast<std::size_t>(missing) < seen_.size())
      reject(of_bvh_file(file_.path, fmt::format("triangle {} is in no leaf",
                                                 numbers_.of_source(static_cast<std::uint32_t>(missing)))));
    if (!parted_.empty()) check_parted();
    for (auto number = from_root.rbegin(); number != from_root.rend(); ++number)
      if (!file_.nodes[*number].is_leaf) take_children(file_.nodes[*number]);
    return static_cast<std::size_t>(std::count(grown_.begin(), grown_.end(), true));
  }

 private:
  void set_box(const FileNode& node, const Aabb& box) {
    const std::uint32_t number = file_.number(node);
    if (equal(box, node.box)) return;
    grown_[number] = true;
    file_.nodes[number].box = box;
  }

  [[nodiscard]] Aabb bounds(std::uint32_t triangle) const {
    const Mesh::Corners corners = scene_.mesh.corners(triangle);
    Aabb box;
    for (const glm::vec3& corner : {corners.a, corners.b, corners.c}) box.grow(corner);
    return box;
  }

  static bool holds(const Aabb& outer, const Aabb& inner) {
    return outer.min == glm::min(outer.min, inner.min) && outer.max == glm::max(outer.max, inner.max);
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
    std::uint32_t kept = leaf.first;
    for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
      const std::uint32_t source = file_.triangles[i];
      if (source >= numbers_.in_source())
        file_.reject(
            leaf, fmt::format("has triangle {}; the scene's are 0 to {}", source, numbers_.in_source() - 1));
      const std::uint32_t triangle = numbers_.in_mesh(source);
      if (triangle == TriangleNumbers::none) continue;
      file_.triangles[kept++] = triangle;
      seen_[triangle] = true;
      const Aabb needed = bounds(triangle);
      set_box(leaf, stretched(leaf.box, needed));
      if (!holds(leaf.box, needed)) parted_.push_back(triangle);
    }
    leaf.count = kept - leaf.first;
  }

  /// A triangle that sticks out of a leaf, and one of its leaves.
  struct Part {
    std::uint32_t triangle;
    std::uint32_t leaf;
    friend auto operator<=>(const Part&, const Part&) = default;
  };

  [[nodiscard]] std::vector<Part> parts() {
    std::sort(parted_.begin(), parted_.end());
    std::vector<Part> parts;
    for (const FileNode& node : file_.nodes) {
      if (!node.is_leaf) continue;
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if (std::binary_search(parted_.begin(), parted_.end(), file_.triangles[i]))
          parts.push_back({file_.triangles[i], file_.number(node)});
      }
    }
    std::sort(parts.begin(), parts.end());
    return parts;
  }

  /// Boxes that hold parts of triangles are grown by the tolerance, because their faces may have been
  /// computed where an edge meets a plane.
  void check_parted() {
    const bool may_grow = tolerance_ > 0.0;
    const std::vector<Part> all = parts();
    std::vector<std::uint32_t> leaves;
    std::vector<Aabb> boxes;
    for (std::size_t first = 0; first < all.size();) {
      const std::uint32_t triangle = all[first].triangle;
      boxes.clear();
      std::size_t last = first;
      for (; last < all.size() && all[last].triangle == triangle; ++last) {
        boxes.push_back(file_.nodes[all[last].leaf].box);
        leaves.push_back(all[last].leaf);
      }
      if (!cover(boxes, scene_.mesh.corners(triangle), may_grow ? tolerance_ : -cover_error))
        reject_uncovered(std::span(all).subspan(first, last - first));
      first = last;
    }
    if (!may_grow) return;
    const double more = tolerance_ + cover_error;
    std::sort(leaves.begin(), leaves.end());
    leaves.erase(std::unique(leaves.begin(), leaves.end()), leaves.end());
    for (const std::uint32_t number : leaves) {
      const FileNode& leaf = file_.nodes[number];
      set_box(leaf, rounded_outward(glm::dvec3(leaf.box.min) - more, glm::dvec3(leaf.box.max) + more));
    }
  }

  [[noreturn]] void reject_uncovered(std::span<const Part> own_parts) const {
    const std::uint32_t triangle = own_parts[0].triangle;
    const Aabb needed = bounds(triangle);
    const auto without = std::find_if(own_parts.begin(), own_parts.end(), [&](const Part& part) {
      return !holds(file_.nodes[part.leaf].box, needed);
    });
    const FileNode& leaf = file_.nodes[without->leaf];
    std::string where;
    for (int axis = 0; axis < 3 && where.empty(); ++axis) {
      const auto own = [&](float x) {
        return file_.space == FileSpace::cube ? double{x} : scene_.to_cube.to_own(glm::dvec3(x))[axis];
      };
      const auto describe = [&](const char* side, float of_triangle, float of_box) {
        where = fmt::format("{}.{} of the triangle is {:.7g}, of the box {:.7g}", side, "xyz"[axis],
                            own(of_triangle), own(of_box));
      };
      if (needed.min[axis] < leaf.box.min[axis]) {
        describe("min", needed.min[axis], leaf.box.min[axis]);
      } else if (needed.max[axis] > leaf.box.max[axis]) {
        describe("max", needed.max[axis], leaf.box.max[axis]);
      }
    }
    const std::size_t others = own_parts.size() - 1;
    file_.reject(leaf, fmt::format("does not hold triangle {}{}: {}", numbers_.of_source(triangle),
                                   others == 0 ? "" : ", and its other leaves do not hold the rest", where));
  }

  void take_children(FileNode& branch) {
    Aabb box = branch.box;
    std::uint32_t kept = branch.first;
    for (std::uint32_t i = branch.first; i < branch.first + branch.count; ++i) {
      const FileNode& child = file_.nodes[file_.children[i]];
      if (child.count == 0) continue;
      file_.children[kept++] = file_.children[i];
      box.grow(child.box);
    }
    branch.count = kept - branch.first;
    if (branch.count > 0) set_box(branch, box);
  }

  BvhFile& file_;
  const Scene& scene_;
  TriangleNumbers numbers_;
  double tolerance_;
  std::vector<bool> seen_;   // by triangle of the mesh
  std::vector<bool> grown_;  // by node
  std::vector<std::uint32_t> parted_;
};

}  // namespace

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
      file.reject(node, fmt::format("reaches from {} to {} along {}; boxes of space cube must lie within -1 "
                                    "and 1",
                                    node.box.min[axis], node.box.max[axis], "xyz"[axis]));
    }
  }
}

std::size_t fit_to_triangles(BvhFile& file, const Scene& scene, double tolerance,
                             std::span<const std::uint32_t> from_root) {
  return Fit(file, scene, tolerance).run(from_root);
}

}  // namespace hitpipe::ref
