// What the traversal loops require of a store of nodes in any encoding.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace hitpipe::ref {

/// Node identifies a node and carries what is needed to decode its children: an index for plain nodes, and
/// also the decoded box for nodes that are stored relative to their parent. Each child() is one load from
/// memory.
template <class S>
concept NodeStore = requires(const S& store, const typename S::Node& node, unsigned which) {
  typename S::Box;  // what a box test takes
  { store.root() } -> std::same_as<typename S::Node>;
  { store.child(node, which) } -> std::same_as<typename S::Node>;  // 0 or 1, of a branch
  { store.box(node) } -> std::convertible_to<const typename S::Box&>;
  { store.count(node) } -> std::same_as<std::int32_t>;   // as BvhNode::count: >= 1 a leaf, -1 - axis a branch
  { store.first(node) } -> std::same_as<std::uint32_t>;  // of a leaf: its first entry of Bvh::order
  { store.index(node) } -> std::same_as<std::uint32_t>;  // of the node, 0 is the root
  { store.size() } -> std::same_as<std::size_t>;
  { S::bytes_per_node } -> std::convertible_to<std::size_t>;
};

}  // namespace hitpipe::ref
