// Section 8.2: the plane of a k-d tree's node as a number of b bits, relative to the node. The builder places
// planes by the surface area heuristic at bounds of triangles. With b bits it moves each plane to the nearest
// of the 2^b - 1 places within the node before it divides the triangles, so nothing can be missed.
#include <algorithm>
#include <array>
#include <numeric>

#include <fmt/format.h>

#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/recording.hpp"
#include "sw_ref/scene/built_in.hpp"
#include "thesis/proposals.hpp"

namespace hitpipe::thesis {
namespace {

constexpr int most_triangles = 6;  // of a leaf, unless splitting costs more
constexpr int deepest = 40;
constexpr std::size_t candidates = 32;  // planes tried on each axis
constexpr double empty_bonus = 0.8;     // cutting off empty space is worth more than the heuristic says

struct KdNode {
  int axis = -1;  // of a branch
  float plane = 0;
  std::uint32_t first = 0;  // branch: child 0, child 1 follows; leaf: its first entry of the order
  std::uint32_t count = 0;  // of a leaf
};

struct KdTree {
  Aabb box;
  std::vector<KdNode> nodes;
  std::vector<std::uint32_t> order;
};

double half_area(const glm::dvec3& side) {
  return side.x * side.y + side.y * side.z + side.z * side.x;
}

class KdBuilder {
 public:
  /// `bits` of a plane; 0: binary32.
  KdBuilder(const Mesh& mesh, int bits) : bits_(bits) {
    boxes_.resize(mesh.triangles.size());
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
      const Mesh::Corners corners = mesh.corners(i);
      for (const glm::vec3& corner : {corners.a, corners.b, corners.c}) boxes_[i].grow(corner);
      tree_.box.grow(boxes_[i]);
    }
  }

  KdTree build() {
    std::vector<std::uint32_t> all(boxes_.size());
    std::iota(all.begin(), all.end(), 0U);
    tree_.nodes.emplace_back();
    build(0, tree_.box, std::move(all), 1);
    return std::move(tree_);
  }

 private:
  struct Split {
    int axis = -1;
    float plane = 0;
    double cost = 0;
  };

  /// The nearest place that the bits can name.
  [[nodiscard]] float named(float plane, float low, float high) const {
    if (bits_ == 0) return plane;
    const double places = std::ldexp(1.0, bits_);
    const double at = std::clamp(std::round((plane - low) / (double{high} - low) * places), 1.0, places - 1);
    return static_cast<float>(low + (double{high} - low) * at / places);
  }

  [[nodiscard]] Split best_split(const Aabb& box, const std::vector<std::uint32_t>& triangles) const {
    Split best;
    best.cost = static_cast<double>(triangles.size());  // of a leaf, in triangle tests
    const glm::dvec3 side = glm::dvec3(box.max) - glm::dvec3(box.min);
    const double area = half_area(side);
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float> lows;
      std::vector<float> highs;
      for (const std::uint32_t triangle : triangles) {
        lows.push_back(boxes_[triangle].min[axis]);
        highs.push_back(boxes_[triangle].max[axis]);
      }
      std::sort(lows.begin(), lows.end());
      std::sort(highs.begin(), highs.end());
      const auto try_plane = [&](float wanted) {
        const float plane = named(wanted, box.min[axis], box.max[axis]);
        if (plane <= box.min[axis] || plane >= box.max[axis]) return;
        const auto left =
            static_cast<double>(std::lower_bound(lows.begin(), lows.end(), plane) - lows.begin());
        const auto right =
            static_cast<double>(highs.end() - std::upper_bound(highs.begin(), highs.end(), plane));
        glm::dvec3 left_side = side;
        glm::dvec3 right_side = side;
        left_side[axis] = double{plane} - box.min[axis];
        right_side[axis] = double{box.max[axis]} - plane;
        const double children = (half_area(left_side) * left + half_area(right_side) * right) / area;
        const double cost = 1 + children * (left == 0 || right == 0 ? empty_bonus : 1.0);
        if (cost < best.cost) best = {axis, plane, cost};
      };
      for (std::size_t i = 0; i < candidates; ++i) {
        const std::size_t at = (triangles.size() - 1) * i / (candidates - 1);
        try_plane(lows[at]);
        try_plane(highs[at]);
      }
    }
    return best;
  }

  void build(std::uint32_t at, const Aabb& box, std::vector<std::uint32_t> triangles, int level) {
    const Split split =
        triangles.size() <= most_triangles || level >= deepest ? Split{} : best_split(box, triangles);
    if (split.axis < 0) {
      tree_.nodes[at] = {-1, 0, static_cast<std::uint32_t>(tree_.order.size()),
                         static_cast<std::uint32_t>(triangles.size())};
      tree_.order.insert(tree_.order.end(), triangles.begin(), triangles.end());
      return;
    }
    std::array<std::vector<std::uint32_t>, 2> parts;
    for (const std::uint32_t triangle : triangles) {
      // One that only touches the plane lies on its own side; one within the plane is given to child 0. A ray
      // that comes so close to the plane visits both.
      const bool above = boxes_[triangle].max[split.axis] > split.plane;
      if (boxes_[triangle].min[split.axis] < split.plane || !above) parts[0].push_back(triangle);
      if (above) parts[1].push_back(triangle);
    }
    triangles = {};
    const auto first = static_cast<std::uint32_t>(tree_.nodes.size());
    tree_.nodes.resize(first + 2);
    tree_.nodes[at] = {split.axis, split.plane, first, 0};
    std::array<Aabb, 2> halves{box, box};
    halves[0].max[split.axis] = split.plane;
    halves[1].min[split.axis] = split.plane;
    for (std::uint32_t child = 0; child < 2; ++child)
      build(first + child, halves.at(child), std::move(parts.at(child)), level + 1);
  }

  int bits_;
  std::vector<Aabb> boxes_;
  KdTree tree_;
};

/// The work of one tree.
struct Work {
  double steps = 0;  ///< nodes visited
  double tests = 0;  ///< triangle tests
  std::uint64_t different = 0;
};

/// Front to back. Distances are doubles; a ray that comes within a rounding of a plane visits both sides.
void trace(const KdTree& tree, const Mesh& mesh, const Ray& ray, Query query, Hit& hit, Work& work) {
  constexpr double slack = 1e-9;
  struct Waiting {
    std::uint32_t node;
    double near, far;
  };
  const glm::dvec3 origin(ray.origin);
  const glm::dvec3 direction(ray.direction);
  double near = 0;
  double far = ray.length;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < tree.box.min[axis] || origin[axis] > tree.box.max[axis]) return;
      continue;
    }
    const double a = (tree.box.min[axis] - origin[axis]) / direction[axis];
    const double b = (tree.box.max[axis] - origin[axis]) / direction[axis];
    near = std::max(near, std::min(a, b));
    far = std::min(far, std::max(a, b));
  }
  const double reach = slack * (1 + (std::isinf(far) ? 0 : std::abs(far)));
  if (near > far + reach) return;
  std::vector<Waiting> stack{{0, near - reach, far + reach}};
  while (!stack.empty()) {
    const Waiting now = stack.back();
    stack.pop_back();
    if (hit.triangle != Hit::none && now.near > hit.t_high) continue;
    const KdNode& node = tree.nodes[now.node];
    work.steps += 1;
    if (node.axis < 0) {
      for (std::uint32_t i = 0; i < node.count; ++i) {
        work.tests += 1;
        if (intersect_triangle(mesh, tree.order[node.first + i], ray, hit) && query == Query::any) return;
      }
      continue;
    }
    const double d = direction[node.axis];
    const double apart = node.plane - origin[node.axis];
    const std::uint32_t below = apart > 0 || (apart == 0 && d <= 0) ? 0 : 1;  // the side of the origin
    const double t = d == 0 ? 0 : apart / d;
    const bool crosses = d != 0 && t >= -reach;
    if (!crosses && std::abs(apart) > slack) {
      stack.push_back({node.first + below, now.near, now.far});
    } else if (!crosses) {
      stack.push_back({node.first, now.near, now.far});
      stack.push_back({node.first + 1, now.near, now.far});
    } else {
      if (t <= now.far + reach)
        stack.push_back({node.first + 1 - below, std::max(now.near, t - reach), now.far});
      if (t >= now.near - reach)
        stack.push_back({node.first + below, now.near, std::min(now.far, t + reach)});
    }
  }
}

constexpr std::array plane_bits{0, 2, 4, 6, 8};

std::vector<Work> measure_planes(const Scene& scene, const ExperimentOptions& options,
                                 std::vector<double>& nodes) {
  const std::vector<RecordedBatch> batches =
      record_rays(scene, build_bvh(scene.mesh), options.width, options.height, 1);
  std::vector<Work> all;
  for (const int bits : plane_bits) {
    const KdTree tree = KdBuilder(scene.mesh, bits).build();
    nodes.push_back(static_cast<double>(tree.nodes.size()));
    Work& work = all.emplace_back();
    for (const RecordedBatch& batch : batches) {
      for (std::size_t i = 0; i < batch.rays.size(); ++i) {
        Hit hit;
        trace(tree, scene.mesh, batch.rays[i], batch.query, hit, work);
        const bool same = batch.query == Query::any
                              ? (hit.triangle == Hit::none) == (batch.triangles[i] == Hit::none)
                              : hit.triangle == batch.triangles[i];
        work.different += same ? 0 : 1;
      }
    }
  }
  return all;
}

}  // namespace

ResultTable kd_planes(std::string_view number, const ExperimentOptions& options) {
  ResultTable table;
  table.number = number;
  table.title = "k-d trees: binary32 planes, then change in % with planes of b bits";
  table.labels = {"scene", "figure"};
  table.columns = {{"fp32", 1}, {"2", 2}, {"4", 2}, {"6", 2}, {"8", 2}};
  const std::vector<std::string> scenes = proposal_scenes(number, options);
  std::uint64_t different = 0;
  for (const std::string& name : scenes) {
    const Scene scene = proposal_scene(name, options);
    std::vector<double> nodes;
    const std::vector<Work> work = measure_planes(scene, options, nodes);
    const auto add = [&](const std::string& what, auto figure, double unit) {
      ResultRow row{.labels = {name, what},
                    .ours = {figure(0) / unit},
                    .printed = std::vector<std::optional<double>>(plane_bits.size())};
      for (std::size_t i = 1; i < plane_bits.size(); ++i)
        row.ours.emplace_back(100 * (figure(i) / figure(0) - 1));
      table.rows.push_back(std::move(row));
    };
    add(
        "nodes", [&](std::size_t i) { return nodes[i]; }, 1);
    add(
        "node steps, 1000", [&](std::size_t i) { return work[i].steps; }, 1000);
    add(
        "triangle tests, 1000", [&](std::size_t i) { return work[i].tests; }, 1000);
    for (const Work& of : work) different += of.different;
    options.progress(static_cast<double>(&name - scenes.data() + 1) / static_cast<double>(scenes.size()));
  }
  table.notes = {
      fmt::format("{} x {} pixels, all rays, all counts of one image; {} answers differ from the BVH's",
                  options.width, options.height, different),
      "a node takes 8 bytes with a binary32 plane, 5 with 8 bits"};
  return table;
}

}  // namespace hitpipe::thesis
