// Traces one ray by the distance of boxes (BVH-Slabs-Dist, section 4.5): walk_near_first() over nodes that each have a
// box of their own. So a box is one load and one test, the root's too.
#pragma once

#include <array>

#include "rays/trace/near_first.hpp"
#include "sw_ref/trace/counting_visitor.hpp"
#include "sw_ref/trace/traversal.hpp"

namespace hitpipe::ref {

/// Counts a node where its box is tested, not where its children are.
class BoxCountingVisitor : public CountingVisitor {
 public:
  using CountingVisitor::CountingVisitor;

  void box(std::uint32_t number) {
    node(number);
    ++counts_.box_tests;
  }
  void branch(std::uint32_t /*number*/, unsigned /*children*/) {}
};

/// The two children of a node of a store.
template <NodeStore Store, class Test>
class StoreChildren {
 public:
  static constexpr std::size_t width = 2;
  struct Node {
    typename Store::Node node;
    std::uint32_t first;
    std::int32_t count;

    [[nodiscard]] bool is_branch() const { return count < 0; }
  };

  StoreChildren(const Store& store, Test test, BoxCountingVisitor& visitor)
      : store_(store), test_(std::move(test)), visitor_(visitor) {}

  [[nodiscard]] Node root() const { return known(store_.root()); }
  /// The box of the root is tested before the walk.
  [[nodiscard]] bool enters_root() { return enters(store_.root(), 0); }
  void cut(float length) { test_.cut(length); }
  unsigned enter(const Node& node) {
    unsigned entered = 0;
    for (unsigned i = 0; i < width; ++i) {
      children_[i] = store_.child(node.node, i);
      entered |= (enters(children_[i], i) ? 1U : 0U) << i;
    }
    return entered;
  }
  [[nodiscard]] unsigned count() const { return width; }
  [[nodiscard]] typename Test::Distance distance(std::size_t i) const { return distances_[i]; }
  [[nodiscard]] Node child(std::size_t i) const { return known(children_[i]); }

 private:
  [[nodiscard]] Node known(const typename Store::Node& node) const {
    const std::int32_t count = store_.count(node);
    return {node, count < 0 ? 0 : store_.first(node), count};
  }
  bool enters(const typename Store::Node& node, std::size_t i) {
    visitor_.box(store_.index(node));
    return test_.enters(store_.box(node), distances_[i]);
  }

  const Store& store_;
  Test test_;
  BoxCountingVisitor& visitor_;
  std::array<typename Store::Node, width> children_;
  std::array<typename Test::Distance, width> distances_;
};

/// As trace_ray(). test.enters() gives the distance of a box, which is never above the distance of a triangle
/// in it.
template <class Store, class Test>
TraceCounts trace_by_distance(const Store& store, const Leaves& leaves, Test test, const Ray& ray,
                              Query query, Hit& hit, Loads loads) {
  BoxCountingVisitor visitor(leaves, ray, query, loads);
  StoreChildren<Store, Test> children(store, std::move(test), visitor);
  if (children.enters_root()) walk_near_first(children, visitor, ray.length);
  hit = visitor.hit();
  return visitor.counts();
}

}  // namespace hitpipe::ref
