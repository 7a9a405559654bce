// Depth-first traversal of one ray through a hierarchy by software, children in a fixed order or near child first
// by direction and split axis (DSA, section 4.5). rays/trace/walk.hpp is for what answers later.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>

#include "rays/exact/exact_triangle.hpp"
#include "rays/trace/child_order.hpp"
#include "rays/trace/leaf.hpp"
#include "rays/tree/bvh.hpp"
#include "sw_ref/hierarchy/plain_nodes.hpp"

namespace hitpipe::ref {

/// A box test belongs to one ray; a functor of (const Ray&) makes it. After cut(length) it may call a box a
/// miss that the ray enters only beyond t = length.
template <class T, class Box>
concept SoftwareBoxTest = requires(T test, const T& asked, const Box& box, float length) {
  test.cut(length);
  { asked(box) } -> std::same_as<bool>;
};

/// At most one sibling waits per level below the root.
constexpr int deepest_stack = BuildOptions::deepest;

/// A child that waits on the stack of a traversal. It is loaded, and so decoded, when its turn comes. Until
/// then its parent represents it.
template <NodeStore Store>
struct Waiting {
  typename Store::Node parent;
  std::uint32_t which;

  Waiting() = default;
  Waiting(const Store&, const typename Store::Node& node, unsigned child) : parent(node), which(child) {}
  [[nodiscard]] typename Store::Node load(const Store& store) const { return store.child(parent, which); }
};

/// A small Node is only an index or pointer and costs nothing to compute, so the child itself waits.
template <NodeStore Store>
requires(sizeof(typename Store::Node) <= sizeof(void*)) struct Waiting<Store> {
  typename Store::Node node;

  Waiting() = default;
  Waiting(const Store& store, const typename Store::Node& parent, unsigned child)
      : node(store.child(parent, child)) {}
  [[nodiscard]] typename Store::Node load(const Store&) const { return node; }
};

template <NodeStore Store>
class DepthFirst {
 public:
  /// `order_class` chooses the near child.
  DepthFirst(const Store& store, unsigned order_class) : node_(store.root()), class_(order_class) {}

  [[nodiscard]] bool done() const { return done_; }
  /// The node whose box is to be tested now. Only while !done().
  [[nodiscard]] const typename Store::Node& node() const { return node_; }
  [[nodiscard]] TraceCounts counts() const { return TraceCounts::of_ray(box_tests_, triangle_tests_); }

  /// Goes on with the result of the box test of node(). `hit` is the best hit so far; it lies outside, so
  /// that the rest can stay in registers. Calls closer() when a leaf has a better hit and the ray goes on.
  template <class Closer>
  [[gnu::always_inline]] void answer(bool box_hit, const Store& store, const Leaves& leaves, const Ray& ray,
                                     Query query, Hit& hit, Loads loads, const Closer& closer) {
    loads.node(store.index(node_));
    ++box_tests_;
    if (box_hit) {
      const std::int32_t count = store.count(node_);
      if (count < 0) {
        const unsigned near = near_child(class_, -1 - count);
        stack_[top_++] = Waiting<Store>(store, node_, near ^ 1U);
        node_ = store.child(node_, near);
        return;
      }
      const auto triangles = leaves.triangles(store.first(node_), count);
      const std::uint32_t before = hit.triangle;
      const std::uint32_t tests = leaves.test->ray(*leaves.mesh, triangles, ray, query, hit);
      loads.triangles(triangles.first(tests));
      triangle_tests_ += tests;
      if (hit.triangle != before) {
        done_ = query == Query::any;
        if (done_) return;
        closer();
      }
    }
    done_ = top_ == 0;
    if (!done_) node_ = stack_[--top_].load(store);
  }

 private:
  typename Store::Node node_;
  std::size_t top_ = 0;
  unsigned class_;
  std::uint32_t box_tests_ = 0;
  std::uint32_t triangle_tests_ = 0;
  bool done_ = false;
  std::array<Waiting<Store>, deepest_stack> stack_;  // only [0, top_) is read, so the rest is not set
};

/// `test` is the box test of `ray`; with `ends` it is cut at each hit. All calls are inlined: a decoded node
/// then stays in registers.
template <class Store, SoftwareBoxTest<typename Store::Box> Test>
[[gnu::flatten]] TraceCounts trace_ray(const Store& store, const Leaves& leaves, Test test, const Ray& ray,
                                       Query query, unsigned order_class, bool ends, Hit& hit, Loads loads) {
  DepthFirst<Store> walk(store, order_class);
  do {
    walk.answer(test(store.box(walk.node())), store, leaves, ray, query, hit, loads, [&] {
      if (ends) test.cut(cull_length(hit));
    });
  } while (!walk.done());
  return walk.counts();
}

/// Traces one ray with the box test Test(ray) and the exact triangle test, near child first.
template <class Test>
Hit trace(const Bvh& bvh, const Mesh& mesh, const Ray& ray, Query query, TraceCounts& counts) {
  Hit hit;
  counts += trace_ray(PlainNodes(bvh), Leaves(mesh, bvh), Test(ray), ray, query,
                      direction_class(ray.direction), true, hit, Loads{});
  return hit;
}

}  // namespace hitpipe::ref
