// A child that waits on the stack of a traversal.
#pragma once

#include <cstdint>

#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/hierarchy/node_store.hpp"

namespace hitpipe::ref {

/// At most one sibling waits per level below the root.
constexpr int deepest_stack = BuildOptions::deepest;

/// A child is loaded, and so decoded, when its turn comes. Until then its parent represents it.
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

}  // namespace hitpipe::ref
