// Traces one ray, with children in a fixed order or by direction and split axis (chapter 4).
#pragma once

#include <array>

#include "sw_ref/trace/child_order.hpp"
#include "sw_ref/trace/trace_parts.hpp"
#include "sw_ref/trace/waiting.hpp"

namespace hitpipe::ref {

/// `order_class` chooses the near child. `test` is the box test of `ray`; with `ends` it is cut at each hit.
/// Returns the work; loads equal tests.
template <class Store, class Test, class Observer>
RayWork trace_ray(const Store& store, const Leaves& leaves, Test&& test, const Ray& ray, Query query,
                  unsigned order_class, bool ends, Hit& hit, Observer& observer) {
  std::array<Waiting<Store>, deepest_stack> stack;
  std::size_t top = 0;
  RayWork work;
  typename Store::Node node = store.root();
  for (;;) {
    observer.node_loaded(store.index(node));
    ++work.box_tests;
    if (test(store.box(node))) {
      const std::int32_t count = store.count(node);
      if (count < 0) {
        const unsigned near = near_child(order_class, -1 - count);
        stack[top++] = Waiting<Store>(store, node, near ^ 1U);
        node = store.child(node, near);
        continue;
      }
      const auto triangles = leaves.triangles(store.first(node), count);
      const std::uint32_t before = hit.triangle;
      const std::uint32_t tests = leaves.test.ray(leaves.mesh, triangles, ray, query, hit);
      tell_loads(observer, triangles.first(tests));
      work.triangle_tests += tests;
      if (hit.triangle != before) {
        if (query == Query::any) return work;
        if (ends) test.cut(cull_length(hit));
      }
    }
    if (top == 0) return work;
    node = stack[--top].load(store);
  }
}

}  // namespace hitpipe::ref
