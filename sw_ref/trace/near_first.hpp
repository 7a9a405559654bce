// Traces one ray through nodes that are loaded with the boxes of all their children. Children that are hit
// are visited near to far. Of many children these are sorted by the distance at which the ray enters them, as
// Embree does and AMD's box instruction can. CWBVH takes the order of octants instead, which saves a thread
// of a GPU the sort. A distance is more exact, and with it a child that waits is dropped without a load when
// a closer hit has been found. Pairs may also go by direction and split axis.
#pragma once

#include <array>
#include <cstddef>
#include <limits>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/hierarchy/near_first_store.hpp"
#include "sw_ref/trace/child_order.hpp"
#include "sw_ref/trace/leaf_test.hpp"
#include "sw_ref/trace/slabs.hpp"
#include "sw_ref/trace/trace_batch.hpp"

namespace hitpipe::ref {

/// Levels of the binary hierarchy, and as many more as halving its largest leaf adds.
inline constexpr std::size_t deepest_near_first =
    BuildOptions::deepest + std::numeric_limits<std::int32_t>::digits;

/// Nodes of two children that know the axis along which they were split.
template <class Store>
concept HasSplitAxis = requires(const Store& store, const BoxedChild& node) {
  { store.split_axis(node) } -> std::same_as<int>;
};

/// The order by direction is of nodes with a split axis; a child is dropped by its distance there too.
template <NearFirstStore Store>
TraceCounts trace_near_first(const Store& store, const Leaves& leaves, ChildOrder order, const Ray& ray,
                             Query query, Hit& hit, Loads loads) {
  struct Waiting {
    BoxedChild child;
    float distance;
  };
  std::array<Waiting, deepest_near_first*(Store::width - 1) + 1> stack;  // only [0, top) is read
  std::array<BoxedChild, Store::width> children;
  ConservativeSlabs test(ray);
  TraceCounts counts{.rays = 1};
  [[maybe_unused]] const unsigned order_class =
      order == ChildOrder::fixed ? 0 : direction_class(ray.direction);
  float length = ray.length;
  stack[0] = {store.root(), 0};
  std::size_t top = 1;
  while (top > 0) {
    const Waiting at = stack[--top];
    if (at.distance > length) continue;
    if (!at.child.is_branch()) {
      const auto triangles = leaves.triangles(at.child.first, at.child.count);
      const std::uint32_t before = hit.triangle;
      const std::uint32_t tests = leaves.test->ray(*leaves.mesh, triangles, ray, query, hit);
      loads.triangles(triangles.first(tests));
      counts.triangle_tests += tests;
      counts.triangles_loaded += tests;
      if (hit.triangle == before) continue;
      if (query == Query::any) break;
      length = cull_length(hit);
      test.cut(length);
      continue;
    }
    loads.node(at.child.first);
    ++counts.nodes_loaded;
    const unsigned count = store.children(at.child, children);
    counts.box_tests += count;
    if constexpr (HasSplitAxis<Store>) {
      if (order != ChildOrder::by_distance) {
        const unsigned near = near_child(order_class, store.split_axis(at.child));
        for (const unsigned which : {near ^ 1U, near}) {
          float distance;
          if (which < count && test.enters(children[which].box, distance))
            stack[top++] = {children[which], distance};
        }
        continue;
      }
    }
    const std::size_t nearest = top;
    for (unsigned i = 0; i < count; ++i) {
      float distance;
      if (!test.enters(children[i].box, distance)) continue;
      std::size_t place = top++;
      // The nearest is to be on top; of equals the first.
      for (; place > nearest && stack[place - 1].distance <= distance; --place)
        stack[place] = stack[place - 1];
      stack[place] = {children[i], distance};
    }
  }
  return counts;
}

}  // namespace hitpipe::ref
