// IntTraversal for a unit that tests two boxes at a time and is told where the ray is within their parent
// (docs/major.md). It pauses at each record of two boxes and at each triangle.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "hls/box/major_format.hpp"
#include "hls/world/world_format.hpp"
#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/trace/child_order.hpp"
#include "sw_ref/trace/pair_traversal.hpp"
#include "sw_ref/trace/tracer.hpp"
#include "sw_ref/world/int_ray.hpp"
#include "sw_ref/world/int_traversal.hpp"
#include "sw_ref/world/int_triangle.hpp"

namespace hitpipe::ref {

/// By record of BvhPairs: the two boxes of a branch. Record 0 has the root's box alone. `boxes` is of
/// int_boxes() for the same hierarchy.
[[nodiscard]] inline std::vector<PairBoxes> int_pairs(std::span<const IntBox> boxes, const Bvh& bvh) {
  std::vector<PairBoxes> pairs(bvh.nodes.size() + 1);
  pairs[0] = {boxes[0], 0};
  for (std::size_t i = 0; i < bvh.nodes.size(); ++i)
    if (const BvhNode& node = bvh.nodes[i]; !node.is_leaf())
      pairs[i + 1] = pair_boxes(boxes[node.first], boxes[node.first + 1]);
  return pairs;
}

/// The hierarchy must outlive it and not change.
class IntPairTraversal {
 public:
  IntPairTraversal(const Bvh& bvh, const IntRay& ray, Query query, const hls::WorldBits& world,
                   const hls::MajorBits& boxes)
      : bvh_(&bvh),
        records_(bvh),
        world_(world),
        boxes_(boxes),
        length_(ray.length),
        parent_{0, in_box_units(ray.length, world, boxes)},
        class_(direction_class(ray)),
        query_(query) {}

  [[nodiscard]] bool done() const { return done_; }
  /// It waits for a triangle, not for two boxes. Only while !done().
  [[nodiscard]] bool at_triangle() const { return triangle_ != triangles_end_; }
  [[nodiscard]] std::uint32_t record() const { return record_; }
  /// Where the ray is within the parent of the two boxes, cut at the ray's length or its best hit, in units
  /// of box distances.
  [[nodiscard]] const RayInterval& parent() const { return parent_; }
  [[nodiscard]] std::uint32_t triangle() const { return bvh_->order[triangle_]; }
  /// As IntTraversal::length().
  [[nodiscard]] std::int64_t length() const { return hit_.found() ? hit_.t : length_; }
  [[nodiscard]] const IntHit& hit() const { return hit_; }
  /// Box tests are boxes: two a record, one for the root.
  [[nodiscard]] TraceCounts counts() const { return TraceCounts::of_ray(box_tests_, triangle_tests_); }

  void answer_boxes(const PairAnswer& answer) {
    box_tests_ += boxes();
    const unsigned nearer = near_child(class_, records_.split_axis(record_));
    for (const unsigned which : {nearer ^ 1U, nearer}) {
      const PairChild child = records_.child(record_, which);
      if (answer.hit[which] && child.count != PairChild::none)
        stack_[top_++] = {child, answer.interval[which]};
    }
    pop();
  }

  /// Boxes that the current test answers for.
  [[nodiscard]] unsigned boxes() const { return records_.child(record_, 1).count == PairChild::none ? 1 : 2; }

  /// As IntTraversal::answer_triangle().
  void answer_triangle(bool met, std::int64_t t) {
    ++triangle_tests_;
    if (met && keep_better(t, triangle(), hit_) && query_ == Query::any) {
      done_ = true;
      return;
    }
    if (++triangle_ == triangles_end_) pop();
  }

 private:
  struct Waiting {
    PairChild child;
    RayInterval interval;
  };

  void pop() {
    const std::int64_t cut = in_box_units(length(), world_, boxes_);
    while (top_ > 0) {
      const Waiting& next = stack_[--top_];
      // What begins at the cut may have a triangle of equal T and lower number.
      if (next.interval.near > cut) continue;
      if (next.child.count == PairChild::branch) {
        record_ = next.child.first;
        parent_ = {next.interval.near, std::min(next.interval.far, cut)};
      } else {
        triangle_ = next.child.first;
        triangles_end_ = triangle_ + static_cast<std::uint32_t>(next.child.count);
      }
      return;
    }
    done_ = true;
  }

  const Bvh* bvh_;
  BvhPairs records_;
  hls::WorldBits world_;
  hls::MajorBits boxes_;
  std::int64_t length_;
  RayInterval parent_;
  IntHit hit_;
  std::uint32_t record_ = 0;
  std::uint32_t triangle_ = 0, triangles_end_ = 0;  ///< places in Bvh::order; equal: it waits for boxes
  std::uint32_t box_tests_ = 0, triangle_tests_ = 0;
  std::size_t top_ = 0;
  unsigned class_;
  Query query_;
  bool done_ = false;
  /// At most one sibling waits per level, and both children of the last.
  std::array<Waiting, std::size_t{BuildOptions::deepest} + 2> stack_;  // only [0, top_) is read
};

}  // namespace hitpipe::ref
