// What the loop that visits children near to far (rays/trace/near_first.hpp) requires of a store of nodes:
// a node is loaded with the boxes of all its children.
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rays/mesh/aabb.hpp"

namespace hitpipe::ref {

/// A box with what is in it.
struct BoxedChild {
  static constexpr std::int32_t branch = 0;

  Aabb box;
  std::int32_t count = branch;  ///< >= 1: triangles of a leaf; else `branch`
  std::uint32_t first = 0;      ///< branch: number of its node; leaf: its first entry of order()

  [[nodiscard]] bool is_branch() const { return count == branch; }
};

/// The same without the box.
struct NodeRef {
  std::uint32_t first = 0;
  std::int32_t count = BoxedChild::branch;

  [[nodiscard]] bool is_branch() const { return count == BoxedChild::branch; }
};

template <class S>
concept NearFirstStore = requires(const S& store, const BoxedChild& node,
                                  std::array<BoxedChild, S::width>& children) {
  { store.root() } -> std::same_as<BoxedChild>;                       // a branch whose box is not tested
  { store.children(node, children) } -> std::same_as<unsigned>;       // how many a branch has
  { store.order() } -> std::same_as<std::span<const std::uint32_t>>;  // triangles, as they lie in memory
  // By node: triangles before it in the array that holds both. Empty: each has an array of its own.
  { store.triangles_before() } -> std::same_as<std::span<const std::uint32_t>>;
  { store.size() } -> std::same_as<std::size_t>;
  { S::bytes_per_node } -> std::convertible_to<std::size_t>;
};

}  // namespace hitpipe::ref
