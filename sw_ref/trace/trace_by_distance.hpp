// Traces one ray by the distance of boxes (BVH-Slabs-Dist, section 4.5). Both children of a branch are
// tested. The nearer is entered first; the farther waits with its distance and is skipped if a closer hit was
// found meanwhile.
#pragma once

#include <array>
#include <utility>

#include "sw_ref/trace/traversal.hpp"

namespace hitpipe::ref {

/// As trace_ray(). test.enters() gives the distance of a box, which is never above the distance of a triangle
/// in it.
template <class Store, class Test>
TraceCounts trace_by_distance(const Store& store, const Leaves& leaves, Test test, const Ray& ray,
                              Query query, Hit& hit, Loads loads) {
  using Node = typename Store::Node;
  using Distance = typename Test::Distance;
  struct Entered {
    Node node;
    Distance distance;
  };
  std::array<Entered, deepest_stack> stack;
  std::size_t top = 0;
  std::uint32_t box_tests = 0;
  std::uint32_t triangle_tests = 0;
  const auto work = [&] { return TraceCounts::of_ray(box_tests, triangle_tests); };
  float length = ray.length;
  const auto enters = [&](const Node& node, Distance& distance) {
    loads.node(store.index(node));
    ++box_tests;
    return test.enters(store.box(node), distance);
  };
  Entered at{store.root(), {}};
  if (!enters(at.node, at.distance)) return work();
  for (;;) {
    const std::int32_t count = store.count(at.node);
    if (count < 0) {
      Entered near{store.child(at.node, 0), {}};
      Entered far{store.child(at.node, 1), {}};
      const bool first = enters(near.node, near.distance);
      const bool second = enters(far.node, far.distance);
      if (first && second) {
        if (far.distance < near.distance) std::swap(near, far);
        stack[top++] = far;
      }
      if (first || second) {
        at = first || !second ? near : far;
        continue;
      }
    } else {
      const auto triangles = leaves.triangles(store.first(at.node), count);
      const std::uint32_t before = hit.triangle;
      const std::uint32_t tests = leaves.test->ray(*leaves.mesh, triangles, ray, query, hit);
      loads.triangles(triangles.first(tests));
      triangle_tests += tests;
      if (hit.triangle != before) {
        if (query == Query::any) return work();
        length = cull_length(hit);
        test.cut(length);
      }
    }
    do {
      if (top == 0) return work();
      at = stack[--top];
    } while (at.distance > length);
  }
}

}  // namespace hitpipe::ref
