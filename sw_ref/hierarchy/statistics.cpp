#include "sw_ref/hierarchy/statistics.hpp"

#include <chrono>

namespace hitpipe::ref {

namespace {

double area_of(const Aabb& box) {
  return half_area(BasicAabb<double>{box.min, box.max});
}

/// Half the surface of the overlap of both boxes; 0 if they do not touch.
double common_area(const Aabb& a, const Aabb& b) {
  const Aabb common{glm::max(a.min, b.min), glm::min(a.max, b.max)};
  for (int axis = 0; axis < 3; ++axis)
    if (common.min[axis] > common.max[axis]) return 0.0;
  return area_of(common);
}

}  // namespace

BvhStatistics statistics(const Bvh& bvh) {
  BvhStatistics result{.nodes = bvh.nodes.size(),
                       .triangles = bvh.order.size(),
                       .depth = bvh.depth,
                       .leaves_of = {},
                       .node_bytes = bvh.nodes.size() * sizeof(BvhNode),
                       .order_bytes = bvh.order.size() * sizeof(std::uint32_t)};
  double branches = 0;
  double leaf_tests = 0;
  double overlaps = 0;
  for (const BvhNode& node : bvh.nodes) {
    if (!node.is_leaf()) {
      branches += area_of(node.box);
      overlaps += common_area(bvh.nodes[node.first].box, bvh.nodes[node.first + 1].box);
      continue;
    }
    const auto count = static_cast<std::size_t>(node.count);
    ++result.leaves;
    if (result.leaves_of.size() <= count) result.leaves_of.resize(count + 1);
    ++result.leaves_of[count];
    leaf_tests += area_of(node.box) * static_cast<double>(count);
  }
  // No line meets a root without surface, so its cost stays 0.
  const double root = area_of(bvh.nodes[0].box);
  if (root > 0.0)
    result.sah_cost = (branches * double{traversal_cost} + leaf_tests * double{intersection_cost}) / root;
  if (branches > 0.0) result.child_overlap = overlaps / branches;
  return result;
}

void sweep_max_triangles(const Mesh& mesh, BuildOptions options,
                         const std::function<void(const SweepStep&)>& visit) {
  for (const int size : appendix_b_sizes) {
    options.max_triangles = size;
    const auto start = std::chrono::steady_clock::now();
    const Bvh bvh = build_bvh(mesh, options);
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    visit({size, seconds.count(), bvh});
  }
}

}  // namespace hitpipe::ref
