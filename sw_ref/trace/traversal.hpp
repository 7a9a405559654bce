// Depth-first traversal of one ray through a BVH, near child first by direction and split axis (DSA, section
// 4.5). It pauses at each box test: it names the node whose box is to be tested, and continues when it gets
// the answer. So a software loop and a pipeline that answers many cycles later use the same traversal.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/judge/triangle_test.hpp"
#include "sw_ref/scene/mesh.hpp"
#include "sw_ref/scene/ray.hpp"
#include "sw_ref/trace/child_order.hpp"
#include "sw_ref/trace/query.hpp"

namespace hitpipe::ref {

struct TraversalCounts {
  std::uint64_t box_tests = 0;
  std::uint64_t triangle_tests = 0;

  TraversalCounts& operator+=(const TraversalCounts& other) {
    box_tests += other.box_tests;
    triangle_tests += other.triangle_tests;
    return *this;
  }
  friend bool operator==(const TraversalCounts&, const TraversalCounts&) = default;
};

/// Hierarchy and mesh must outlive the traversal and not change. The hierarchy has at least one node.
class Traversal {
 public:
  Traversal(const Bvh& bvh, const Mesh& mesh, const Ray& ray, Query query)
      : nodes_(bvh.nodes.data()),
        order_(bvh.order.data()),
        mesh_(&mesh),
        ray_(ray),
        length_(ray.length),
        class_(direction_class(ray.direction)),
        query_(query) {
    stack_[0] = finished;
  }

  [[nodiscard]] bool done() const { return node_ == finished; }
  /// The node whose box is to be tested now. Only while !done().
  [[nodiscard]] std::uint32_t node() const { return node_; }
  /// A box that the ray enters beyond this t need not be visited. It is the ray's length, or the exact t of
  /// the best hit rounded up.
  [[nodiscard]] float length() const { return length_; }
  [[nodiscard]] const Ray& ray() const { return ray_; }
  /// The best hit so far; final when done().
  [[nodiscard]] const Hit& hit() const { return hit_; }
  [[nodiscard]] TraversalCounts counts() const { return {box_tests_, triangle_tests_}; }

  /// Continues with the result of the box test of node(): true if the ray, cut at length(), may meet its box.
  void answer(bool box_hit) {
    ++box_tests_;
    if (box_hit) {
      const BvhNode& node = nodes_[node_];
      if (!node.is_leaf()) {
        const unsigned near = near_child(class_, node.split_axis());
        stack_[++top_] = node.first + (near ^ 1U);
        node_ = node.first + near;
        return;
      }
      if (intersect(node)) {
        node_ = finished;
        return;
      }
    }
    node_ = stack_[top_--];
  }

 private:
  static constexpr std::uint32_t finished = ~0U;
  /// `finished` is at the bottom. Above it there is at most one waiting sibling per level below the root.
  static constexpr std::size_t stack_size = 64;
  static_assert(stack_size >= std::size_t{BuildOptions::deepest});

  /// Tests the triangles of a leaf; true when the query needs no further node.
  bool intersect(const BvhNode& leaf) {
    const std::uint32_t* const triangles = order_ + leaf.first;
    for (std::int32_t i = 0; i < leaf.count; ++i) {
      ++triangle_tests_;
      if (!intersect_triangle(*mesh_, triangles[i], ray_, hit_)) continue;
      length_ = cull_length(hit_);
      if (query_ == Query::any) return true;
    }
    return false;
  }

  const BvhNode* nodes_;
  const std::uint32_t* order_;
  const Mesh* mesh_;
  Ray ray_;
  Hit hit_;
  float length_;
  std::uint32_t node_ = 0;
  std::uint32_t top_ = 0;
  unsigned class_;
  std::uint32_t box_tests_ = 0;
  std::uint32_t triangle_tests_ = 0;
  Query query_;
  std::array<std::uint32_t, stack_size> stack_;  // only [0, top_] is read, so the rest is not set
};

/// Traces one ray with the box test Test(ray), see box_test.hpp.
template <class Test>
Hit trace(const Bvh& bvh, const Mesh& mesh, const Ray& ray, Query query, TraversalCounts& counts) {
  Test test(ray);
  Traversal traversal(bvh, mesh, ray, query);
  float length = traversal.length();
  while (!traversal.done()) {
    traversal.answer(test(bvh.nodes[traversal.node()].box));
    if (traversal.length() == length) continue;
    length = traversal.length();
    test.cut(length);
  }
  counts += traversal.counts();
  return traversal.hit();
}

}  // namespace hitpipe::ref
