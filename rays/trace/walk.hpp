// One ray's depth-first walk through a hierarchy, near child first by direction and split axis (DSA, thesis
// section 4.5). It pauses at each question, names it, and goes on with the answer. So software and pipelines that
// answer many cycles later use it alike, and the order of the questions is the same. BoxWalk asks for one box at a
// time, RecordWalk for the two boxes of a record. A world says what rays and triangles are: FloatWorld tests the
// triangles of a leaf itself; in IntWorld (rays/trace/int_world.hpp) each triangle is a question too.
// Hierarchy and mesh must outlive a walk and not change. The hierarchy has at least one node.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "rays/exact/exact_triangle.hpp"
#include "rays/trace/child_order.hpp"
#include "rays/trace/leaf.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/pair_nodes.hpp"

namespace hitpipe::ref {

/// Rays in binary32 and the exact triangle test.
class FloatWorld {
 public:
  static constexpr bool asks_triangles = false;

  FloatWorld(const Leaves& leaves, const Ray& ray, Loads loads = {})
      : leaves_(leaves), ray_(ray), length_(ray.length), loads_(loads) {}
  FloatWorld(const Mesh& mesh, const Bvh& bvh, const Ray& ray, Loads loads = {})
      : FloatWorld(Leaves(mesh, bvh), ray, loads) {}

  [[nodiscard]] unsigned order_class() const { return direction_class(ray_.direction); }
  [[nodiscard]] const Ray& ray() const { return ray_; }
  /// A box that the ray enters beyond this t need not be visited. It is the ray's length, or the exact t of
  /// the best hit rounded up.
  [[nodiscard]] float length() const { return length_; }
  [[nodiscard]] const Hit& hit() const { return hit_; }
  void loads(std::uint32_t node) const { loads_.node(node); }

  /// Returns whether the leaf has a better hit.
  bool enter_leaf(std::uint32_t first, std::int32_t count, Query query, TraceCounts& counts) {
    const std::uint32_t before = hit_.triangle;
    const auto triangles = leaves_.triangles(first, count);
    const std::uint32_t tests = leaves_.test->ray(*leaves_.mesh, triangles, ray_, query, hit_);
    loads_.triangles(triangles.first(tests));
    counts.triangle_tests += tests;
    counts.triangles_loaded += tests;
    if (hit_.triangle == before) return false;
    length_ = cull_length(hit_);
    return true;
  }

 private:
  Leaves leaves_;
  Ray ray_;
  Hit hit_;
  float length_;
  Loads loads_;
};

/// What all walks have. `Next` goes to the next question, or ends the walk.
template <class World>
class Walk {
 public:
  [[nodiscard]] bool done() const { return done_; }
  /// It waits for a triangle, not for boxes. Only while !done().
  [[nodiscard]] bool at_triangle() const {
    if constexpr (World::asks_triangles) return world_.at_triangle();
    return false;
  }
  [[nodiscard]] std::uint32_t triangle() const { return world_.triangle(); }
  /// Nothing beyond it is of interest: the length of the ray, or that of its best hit.
  [[nodiscard]] auto length() const { return world_.length(); }
  [[nodiscard]] const auto& ray() const { return world_.ray(); }
  /// The best hit so far; final when done().
  [[nodiscard]] const auto& hit() const { return world_.hit(); }
  /// Box tests are boxes: a record has two, that of the root one.
  [[nodiscard]] const TraceCounts& counts() const { return counts_; }

 protected:
  Walk(World world, Query query) : world_(std::move(world)), class_(world_.order_class()), query_(query) {}

  enum class Leaf {
    left,      ///< nothing to keep
    improved,  ///< with a better hit
    stays,     ///< the walk waits in it, or is done
  };
  Leaf enter_leaf(std::uint32_t first, std::int32_t count) {
    return after(world_.enter_leaf(first, count, query_, counts_));
  }
  Leaf leave_triangle(bool met, std::int64_t t) {
    ++counts_.triangle_tests;
    ++counts_.triangles_loaded;
    return after(world_.answer(met, t));
  }

  World world_;
  TraceCounts counts_{.rays = 1};
  unsigned class_;  ///< chooses the near child
  bool done_ = false;

 private:
  Leaf after(bool better) {
    done_ = better && query_ == Query::any;
    if (done_ || at_triangle()) return Leaf::stays;
    return better ? Leaf::improved : Leaf::left;
  }

  Query query_;
};

template <class World>
class BoxWalk : public Walk<World> {
 public:
  /// Over what is below the node.
  BoxWalk(const Bvh& bvh, World world, Query query, std::uint32_t node = 0)
      : Walk<World>(std::move(world), query), bvh_(&bvh), node_(node) {}

  /// The node whose box is to be tested now.
  [[nodiscard]] std::uint32_t node() const { return node_; }

  /// May the ray, cut at length(), meet the box of node()?
  void answer(bool met) {
    ++this->counts_.box_tests;
    ++this->counts_.nodes_loaded;
    this->world_.loads(node_);
    const BvhNode& node = bvh_->nodes[node_];
    if (met && !node.is_leaf()) {
      const unsigned near = near_child(this->class_, node.split_axis());
      stack_[top_++] = node.first + (near ^ 1U);
      node_ = node.first + near;
      return;
    }
    if (!met || this->enter_leaf(node.first, node.count) != Walk<World>::Leaf::stays) next();
  }
  /// Where the ray meets triangle(); `met` is false, or `t` is at most the ray's own length.
  void answer_triangle(bool met, std::int64_t t) {
    if (this->leave_triangle(met, t) != Walk<World>::Leaf::stays) next();
  }

 private:
  void next() {
    this->done_ = top_ == 0;
    if (!this->done_) node_ = stack_[--top_];
  }

  const Bvh* bvh_;
  std::uint32_t node_;
  std::uint32_t top_ = 0;
  /// At most one sibling waits per level below the root.
  std::array<std::uint32_t, BuildOptions::deepest> stack_;  // only [0, top_) is read, so the rest is not set
};

/// What a test of two boxes tells.
struct PairAnswer {
  std::array<bool, 2> hit{};
  std::array<RayInterval, 2> interval{};  ///< of a box that is hit; others have none
  bool second_first = false;              ///< the ray enters the second box before the first
};

/// A hierarchy as records, without a copy. A branch's record has the number of its node plus one; the first
/// record has the root alone.
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

/// Records are a class with child(record, which) and split_axis(record). A unit for them is told where the ray
/// is within the parent of the two boxes (docs/never_misses.md).
template <class World, class Records>
class RecordWalk : public Walk<World> {
 public:
  /// `length` is the ray's in units of the results.
  RecordWalk(const Records& records, World world, Query query, std::int64_t length)
      : Walk<World>(std::move(world), query), records_(&records), cut_(length), parent_{0, length} {}

  /// The record whose boxes are to be tested now.
  [[nodiscard]] std::uint32_t record() const { return record_; }
  /// Boxes that it has.
  [[nodiscard]] unsigned boxes() const {
    return records_->child(record_, 1).count == PairChild::none ? 1 : 2;
  }
  /// Where the ray is within the record's parent, cut at length().
  [[nodiscard]] const RayInterval& parent() const { return parent_; }

  /// in_results(length) is a length of the ray in units of the results.
  template <class InResults>
  void answer(const PairAnswer& answer, const InResults& in_results) {
    this->counts_.box_tests += boxes();
    ++this->counts_.nodes_loaded;
    this->world_.loads(record_);
    const unsigned nearer = near_child(this->class_, records_->split_axis(record_));
    for (const unsigned which : {nearer ^ 1U, nearer}) {
      if (!answer.hit[which]) continue;
      const PairChild child = records_->child(record_, which);
      if (child.count != PairChild::none) stack_[top_++] = {child, answer.interval[which]};
    }
    next(in_results);
  }
  /// As BoxWalk::answer_triangle().
  template <class InResults>
  void answer_triangle(bool met, std::int64_t t, const InResults& in_results) {
    if (left(this->leave_triangle(met, t), in_results)) next(in_results);
  }

 private:
  using Leaf = typename Walk<World>::Leaf;
  struct Waiting {
    PairChild child;
    RayInterval interval;
  };

  template <class InResults>
  bool left(Leaf leaf, const InResults& in_results) {
    if (leaf == Leaf::improved || (leaf == Leaf::stays && World::asks_triangles))
      cut_ = in_results(this->length());
    return leaf != Leaf::stays;
  }
  template <class InResults>
  void next(const InResults& in_results) {
    while (top_ > 0) {
      const Waiting& waiting = stack_[--top_];
      // What a closer hit has cut off needs no test. What begins at the cut may have a triangle of equal t
      // and lower number.
      if (waiting.interval.near > cut_) continue;
      if (waiting.child.count == PairChild::branch) {
        record_ = waiting.child.first;
        parent_ = {waiting.interval.near, std::min(waiting.interval.far, cut_)};
        return;
      }
      if (!left(this->enter_leaf(waiting.child.first, waiting.child.count), in_results)) return;
    }
    this->done_ = true;
  }

  const Records* records_;
  std::int64_t cut_;  ///< the length in units of the results
  RayInterval parent_;
  std::uint32_t record_ = 0;
  std::size_t top_ = 0;
  /// At most one sibling waits per level, and both children of the last.
  std::array<Waiting, std::size_t{BuildOptions::deepest} + 2> stack_;  // only [0, top_) is read
};

}  // namespace hitpipe::ref
