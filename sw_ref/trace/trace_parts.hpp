// What the traversal loops share: the triangles, and an observer of loads.
#pragma once

#include <cstdint>
#include <span>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/scene/mesh.hpp"
#include "sw_ref/trace/leaf_test.hpp"

namespace hitpipe::ref {

/// An observer is told of each load of a node (index in the hierarchy) or triangle (index in the mesh), in
/// order. This one ignores them; a paging model counts them.
struct NoObserver {
  void node_loaded(std::uint32_t) {}
  void triangle_loaded(std::uint32_t) {}
};

/// The triangles, leaf by leaf, and how to test them.
struct Leaves {
  const Mesh& mesh;
  std::span<const std::uint32_t> order;
  const LeafTest& test;

  [[nodiscard]] std::span<const std::uint32_t> triangles(std::uint32_t first, std::int32_t count) const {
    return order.subspan(first, static_cast<std::size_t>(count));
  }
};

template <class Observer>
void tell_loads(Observer& observer, std::span<const std::uint32_t> triangles) {
  for (const std::uint32_t triangle : triangles) observer.triangle_loaded(triangle);
}

}  // namespace hitpipe::ref
