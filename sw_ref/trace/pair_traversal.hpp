// Depth-first traversal of one ray through the records of a hierarchy, two boxes at a time, near child first
// by direction and split axis. As Traversal does (traversal.hpp), it pauses at each test: it names the record
// that is to be tested and continues when it gets the answer. A record stands for a branch and has its two
// children; the first record has the root alone. Records are a class with
//   child(record, which), split_axis(record)
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "sw_ref/hierarchy/pair_nodes.hpp"
#include "sw_ref/trace/traversal.hpp"

namespace hitpipe::ref {

/// What a test of two boxes tells.
struct PairAnswer {
  std::array<bool, 2> hit{};
  std::array<RayInterval, 2> interval{};  ///< of a box that is hit; others have none
  bool second_first = false;              ///< the ray enters the second box before the first
};

/// A hierarchy as records, without a copy. A branch's record has the number of its node plus one.
class BvhPairs {
 public:
  explicit BvhPairs(const Bvh& bvh) : nodes_(bvh.nodes) {}

  [[nodiscard]] PairChild child(std::uint32_t record, unsigned which) const {
    if (record == 0 && which == 1) return {};
    const std::uint32_t node = first_node(record) + which;
    if (nodes_[node].is_leaf()) return {nodes_[node].count, nodes_[node].first};
    return {PairChild::branch, node + 1};
  }
  [[nodiscard]] int split_axis(std::uint32_t record) const {
    return record == 0 ? 0 : nodes_[record - 1].split_axis();
  }
  /// The node that is child 0; child 1 follows it.
  [[nodiscard]] std::uint32_t first_node(std::uint32_t record) const {
    return record == 0 ? 0 : nodes_[record - 1].first;
  }

 private:
  std::span<const BvhNode> nodes_;
};

/// What a pair traversal is made of; all of it must outlive the traversal and not change.
template <class Records>
struct PairHierarchy {
  const Records* records;
  Leaves leaves;
};

template <class Records>
class PairTraversal {
 public:
  /// `length` is the ray's in units of the results.
  PairTraversal(const PairHierarchy<Records>& scene, const Ray& ray, Query query, std::int64_t length,
                Loads loads = {})
      : scene_(scene),
        ray_(ray),
        length_(ray.length),
        cut_(length),
        parent_{0, cut_},
        class_(direction_class(ray.direction)),
        query_(query),
        loads_(loads) {}

  [[nodiscard]] bool done() const { return done_; }
  /// The record whose boxes are to be tested now. Only while !done().
  [[nodiscard]] std::uint32_t record() const { return record_; }
  /// Where the ray is within the record's parent, cut at length().
  [[nodiscard]] const RayInterval& parent() const { return parent_; }
  /// A box that the ray enters beyond this t need not be visited.
  [[nodiscard]] float length() const { return length_; }
  [[nodiscard]] const Ray& ray() const { return ray_; }
  /// The best hit so far; final when done().
  [[nodiscard]] const Hit& hit() const { return hit_; }
  /// Boxes, not tests: two a test, one for the root.
  [[nodiscard]] TraceCounts counts() const { return counts_; }

  /// in_results(length) is a shorter length of the ray in units of the results.
  template <class InResults>
  void answer(const PairAnswer& answer, const InResults& in_results) {
    counts_.box_tests += boxes();
    ++counts_.nodes_loaded;
    loads_.node(record_);
    const unsigned nearer = near_child(class_, scene_.records->split_axis(record_));
    for (const unsigned which : {nearer ^ 1U, nearer}) {
      if (!answer.hit[which]) continue;
      const PairChild child = scene_.records->child(record_, which);
      if (child.count != PairChild::none) stack_[top_++] = {child, answer.interval[which]};
    }
    advance(in_results);
  }

  /// Boxes that the current test answers for.
  [[nodiscard]] unsigned boxes() const {
    return scene_.records->child(record_, 1).count == PairChild::none ? 1 : 2;
  }

 private:
  struct Waiting {
    PairChild child;
    RayInterval interval;
  };

  /// Tests the triangles of leaves on the way to the next branch.
  template <class InResults>
  void advance(const InResults& in_results) {
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
      const Leaves& leaves = scene_.leaves;
      const auto triangles = leaves.triangles(next.child.first, next.child.count);
      const std::uint32_t tests = leaves.test->ray(*leaves.mesh, triangles, ray_, query_, hit_);
      loads_.triangles(triangles.first(tests));
      counts_.triangle_tests += tests;
      counts_.triangles_loaded += tests;
      if (hit_.triangle == before) continue;
      if (query_ == Query::any) break;
      length_ = cull_length(hit_);
      cut_ = in_results(length_);
    }
    done_ = true;
  }

  PairHierarchy<Records> scene_;
  Ray ray_;
  Hit hit_;
  float length_;
  std::int64_t cut_;  ///< the length in units of the results
  RayInterval parent_;
  TraceCounts counts_{.rays = 1};
  std::uint32_t record_ = 0;
  std::size_t top_ = 0;
  unsigned class_;
  Query query_;
  Loads loads_;
  bool done_ = false;
  /// At most one sibling waits per level, and both children of the last.
  std::array<Waiting, std::size_t{BuildOptions::deepest} + 2> stack_;  // only [0, top_) is read
};

}  // namespace hitpipe::ref
