// Depth-first traversal of a ray through a hierarchy of the integer world. It pauses at each box and each
// triangle, names it, and goes on with the answer. So software and hardware can give the answers, and the
// order of the tests is the same.
#pragma once

#include <array>
#include <cstdint>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/trace/child_order.hpp"
#include "sw_ref/trace/tracer.hpp"
#include "sw_ref/world/int_ray.hpp"
#include "sw_ref/world/int_triangle.hpp"

namespace hitpipe::ref {

/// Bits 0..2: the direction is negative along x, y, z.
[[nodiscard]] inline unsigned direction_class(const IntRay& ray) {
  return static_cast<unsigned>(ray.negative[0]) | static_cast<unsigned>(ray.negative[1]) << 1U |
         static_cast<unsigned>(ray.negative[2]) << 2U;
}

/// The hierarchy must outlive it and not change. An empty mesh has no hierarchy: see IntTracer.
class IntTraversal {
 public:
  IntTraversal(const Bvh& bvh, const IntRay& ray, Query query)
      : bvh_(&bvh), length_(ray.length), class_(direction_class(ray)), query_(query) {}

  [[nodiscard]] bool done() const { return done_; }
  /// It waits for a triangle, not for a box. Only while !done().
  [[nodiscard]] bool at_triangle() const { return triangle_ != triangles_end_; }
  [[nodiscard]] std::uint32_t node() const { return node_; }
  [[nodiscard]] std::uint32_t triangle() const { return bvh_->order[triangle_]; }
  /// No T beyond it is of interest: the length of the ray, or T of the best hit. Boxes are cut there.
  [[nodiscard]] std::int64_t length() const { return hit_.found() ? hit_.t : length_; }
  [[nodiscard]] const IntHit& hit() const { return hit_; }
  [[nodiscard]] TraceCounts counts() const { return TraceCounts::of_ray(box_tests_, triangle_tests_); }

  /// Does the ray, cut at length(), meet the box of node()?
  void answer_box(bool met) {
    ++box_tests_;
    const BvhNode& node = bvh_->nodes[node_];
    if (met && !node.is_leaf()) {
      const unsigned near = near_child(class_, node.split_axis());
      stack_[top_++] = node.first + (near ^ 1U);
      node_ = node.first + near;
      return;
    }
    if (met) {
      triangle_ = node.first;
      triangles_end_ = node.first + static_cast<std::uint32_t>(node.count);
      return;
    }
    pop();
  }

  /// Where the ray meets triangle(); `met` is false, or T is at most the ray's own length.
  void answer_triangle(bool met, std::int64_t t) {
    ++triangle_tests_;
    if (met && keep_better(t, triangle(), hit_) && query_ == Query::any) {
      done_ = true;
      return;
    }
    if (++triangle_ == triangles_end_) pop();
  }

 private:
  void pop() {
    done_ = top_ == 0;
    if (!done_) node_ = stack_[--top_];
  }

  const Bvh* bvh_;
  std::int64_t length_;
  IntHit hit_;
  std::uint32_t node_ = 0;
  std::uint32_t triangle_ = 0, triangles_end_ = 0;  ///< places in Bvh::order; equal: it waits for a box
  std::uint32_t top_ = 0;
  std::uint32_t box_tests_ = 0, triangle_tests_ = 0;
  unsigned class_;
  Query query_;
  bool done_ = false;
  std::array<std::uint32_t, BuildOptions::deepest> stack_;  // only [0, top_) is read, so the rest is not set
};

}  // namespace hitpipe::ref
