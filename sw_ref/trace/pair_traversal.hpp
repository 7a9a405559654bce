// Depth-first traversal of one ray through the records of a hierarchy, two boxes at a time, near child first
// by direction and split axis. As Traversal does (traversal.hpp), it pauses at each test: it names the record
// that is to be tested and continues when it gets the answer.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sw_ref/hierarchy/pair_nodes.hpp"
#include "sw_ref/judge/triangle_test.hpp"
#include "sw_ref/quantise/int_major_ray.hpp"
#include "sw_ref/trace/child_order.hpp"
#include "sw_ref/trace/int_major_pair.hpp"
#include "sw_ref/trace/leaf_test.hpp"
#include "sw_ref/trace/traversal.hpp"

namespace hitpipe::ref {

/// What a pair traversal is made of; all of it must outlive the traversal and not change.
struct PairScene {
  const PairNodes* records;
  const Mesh* mesh;
  std::span<const std::uint32_t> order;
  const LeafTest* leaf_test;
};

class PairTraversal {
 public:
  /// `set_up` is that of the ray.
  PairTraversal(const PairScene& scene, const Ray& ray, Query query, const IntMajorRaySetup& set_up)
      : scene_(scene),
        set_up_(set_up),
        ray_(ray),
        length_(ray.length),
        cut_(set_up_.length(ray.length)),
        parent_{0, cut_},
        class_(direction_class(ray.direction)),
        query_(query) {}

  [[nodiscard]] bool done() const { return done_; }
  /// The record whose boxes are to be tested now. Only while !done().
  [[nodiscard]] std::uint32_t record() const { return record_; }
  /// Where the ray is within the record's parent, cut at length().
  [[nodiscard]] const MajorInterval& parent() const { return parent_; }
  /// A box that the ray enters beyond this t need not be visited.
  [[nodiscard]] float length() const { return length_; }
  [[nodiscard]] const Ray& ray() const { return ray_; }
  /// The best hit so far; final when done().
  [[nodiscard]] const Hit& hit() const { return hit_; }
  /// Boxes, not tests: two a test, one for the root.
  [[nodiscard]] TraversalCounts counts() const { return counts_; }

  void answer(const PairAnswer& answer) {
    counts_.box_tests += boxes();
    const unsigned nearer = near_child(class_, scene_.records->split_axis(record_));
    for (const unsigned which : {nearer ^ 1U, nearer}) {
      if (!answer.hit[which]) continue;
      const PairChild child = scene_.records->child(record_, which);
      if (child.count != PairChild::none) stack_[top_++] = {child, answer.interval[which]};
    }
    advance();
  }

  /// Boxes that the current test answers for.
  [[nodiscard]] unsigned boxes() const {
    return scene_.records->child(record_, 1).count == PairChild::none ? 1 : 2;
  }

 private:
  struct Waiting {
    PairChild child;
    MajorInterval interval;
  };

  /// Tests the triangles of leaves on the way to the next branch.
  void advance() {
    while (top_ > 0) {
      const Waiting& next = stack_[--top_];
      // What a closer hit has cut off needs no test.
      if (next.interval.near > cut_) continue;
      if (next.child.count == PairChild::branch) {
        record_ = next.child.first;
        parent_ = {next.interval.near, std::min(next.interval.far, cut_)};
        return;
      }
      const std::uint32_t before = hit_.triangle;
      counts_.triangle_tests += scene_.leaf_test->ray(
          *scene_.mesh, scene_.order.subspan(next.child.first, static_cast<std::size_t>(next.child.count)),
          ray_, query_, hit_);
      if (hit_.triangle == before) continue;
      if (query_ == Query::any) break;
      length_ = cull_length(hit_);
      cut_ = set_up_.length(length_);
    }
    done_ = true;
  }

  PairScene scene_;
  IntMajorRaySetup set_up_;
  Ray ray_;
  Hit hit_;
  float length_;
  std::int64_t cut_;  ///< the length in units of distances
  MajorInterval parent_;
  TraversalCounts counts_;
  std::uint32_t record_ = 0;
  std::size_t top_ = 0;
  unsigned class_;
  Query query_;
  bool done_ = false;
  /// At most one sibling waits per level, and both children of the last.
  std::array<Waiting, std::size_t{BuildOptions::deepest} + 2> stack_;  // only [0, top_) is read
};

}  // namespace hitpipe::ref
