// Traces one ray through nodes that are loaded with the boxes of all their children. Children that are hit
// are visited near to far. Of many children these are sorted by the distance at which the ray enters them, as
// Embree does and AMD's box instruction can. CWBVH takes the order of octants instead, which saves a thread
// of a GPU the sort. A distance is more exact, and with it a child that waits is dropped without a load when
// a closer hit has been found. Pairs may also go by direction and split axis.
#pragma once

#include <array>
#include <bit>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

#include "rays/trace/child_order.hpp"
#include "rays/trace/child_slabs.hpp"
#include "rays/trace/slabs.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/tree/near_first_store.hpp"

namespace hitpipe::ref {

/// Levels of the binary hierarchy, and as many more as halving its largest leaf adds.
inline constexpr std::size_t deepest_near_first =
    BuildOptions::deepest + std::numeric_limits<std::int32_t>::digits;

/// Nodes of two children that know the axis along which they were split.
template <class Children>
concept HasSplitAxis = requires(const Children& children, const typename Children::Node& node) {
  { children.split_axis(node) } -> std::same_as<int>;
};

/// The children of a wide node, tested together. A node is known by its number.
template <class Store, class Lanes = FourLanes, Widening widening = Widening::of_distances,
          class ItsRay = Ray>
class WideChildren {
 public:
  using Node = NodeRef;
  static constexpr std::size_t width = Store::width;

  WideChildren(const Store& store, const ItsRay& ray) : store_(store), test_(ray) {}

  [[nodiscard]] Node root() const { return {}; }
  void cut(float length) { test_.cut(length); }
  /// Loads a branch. Bit i: the ray may meet child i.
  unsigned enter(const Node& node) {
    at_ = &store_.node(node.first);
    const auto& planes = at_->decoded_planes();
    return test_.enters(planes, distances_) & ((1U << at_->children()) - 1);
  }
  // Of the branch that was entered last.
  [[nodiscard]] unsigned count() const { return at_->children(); }
  [[nodiscard]] float distance(std::size_t i) const { return distances_[i]; }
  [[nodiscard]] Node child(std::size_t i) const { return at_->child(i); }

 private:
  using Stored = std::remove_reference_t<decltype(std::declval<const Store&>().node(0))>;

  const Store& store_;
  ChildSlabs<Lanes, width, widening, ItsRay> test_;
  Stored* at_ = nullptr;
  alignas(32) float distances_[width];
};

/// The two of a pair, which is decoded relative to its own box.
template <class Store>
class PairChildren {
 public:
  using Node = BoxedChild;
  static constexpr std::size_t width = 2;

  PairChildren(const Store& store, const Ray& ray) : store_(store), test_(ray) {}

  [[nodiscard]] Node root() const { return store_.root(); }
  void cut(float length) { test_.cut(length); }
  unsigned enter(const Node& node) {
    count_ = store_.children(node, children_);
    unsigned entered = 0;
    for (unsigned i = 0; i < count_; ++i)
      entered |= (test_.enters(children_[i].box, distances_[i]) ? 1U : 0U) << i;
    return entered;
  }
  [[nodiscard]] unsigned count() const { return count_; }
  [[nodiscard]] float distance(std::size_t i) const { return distances_[i]; }
  [[nodiscard]] const Node& child(std::size_t i) const { return children_[i]; }
  [[nodiscard]] int split_axis(const Node& node) const { return store_.split_axis(node); }

 private:
  const Store& store_;
  ConservativeSlabs test_;
  std::array<BoxedChild, 2> children_;
  float distances_[2];
  unsigned count_ = 0;
};

/// Places for so many, which are not set: setting them all would take longer than the walk.
template <class T, std::size_t places>
struct UnsetStack {
  union {
    T at[places];
  };
  UnsetStack() {}  // NOLINT(modernize-use-equals-default): the default would be deleted
  T& operator[](std::size_t i) { return at[i]; }
};

/// What a leaf did to the walk.
enum class AfterLeaf : std::uint8_t { same, shorter, stop };

/// Walks over the nodes that the ray may meet. `visitor.branch(number, children)` is told of each branch;
/// `visitor.leaf(first, count)` tests the triangles of a leaf, and `visitor.length()` is the length to which
/// they have shortened the ray. It is inlined: children keep what they have set up in registers. `axis_class`: of
/// direction_class(), or nothing to go by distance.
template <class Children, class Visitor>
[[gnu::always_inline]] inline void walk_near_first(Children& children, Visitor& visitor, float length,
                                                   [[maybe_unused]] const unsigned* axis_class = nullptr) {
  using Node = typename Children::Node;
  using Distance = std::decay_t<decltype(children.distance(0))>;
  struct Waiting {
    Node node;
    Distance distance;
  };
  UnsetStack<Waiting, deepest_near_first*(Children::width - 1) + 1> stack;  // only [0, top) is read
  std::size_t top = 0;
  Node at = children.root();
  for (;;) {
    if (at.is_branch()) {
      unsigned entered = children.enter(at);
      visitor.branch(at.first, children.count());
      bool sorted = false;
      if constexpr (HasSplitAxis<Children>) {
        if (axis_class != nullptr) {
          const unsigned near = near_child(*axis_class, children.split_axis(at));
          for (const unsigned which : {near ^ 1U, near}) {
            if ((entered >> which & 1U) != 0)
              stack[top++] = {children.child(which), children.distance(which)};
          }
          sorted = true;
        }
      }
      if (!sorted && entered != 0) {
        auto i = static_cast<std::size_t>(std::countr_zero(entered));
        entered &= entered - 1;
        if (entered == 0) {
          at = children.child(i);
          continue;
        }
        // Two are by far the most frequent of several; the nearer one needs no stack. Of equals the first is
        // nearer.
        auto j = static_cast<std::size_t>(std::countr_zero(entered));
        entered &= entered - 1;
        if (children.distance(j) < children.distance(i)) std::swap(i, j);
        const std::size_t nearest = top;
        stack[top++] = {children.child(j), children.distance(j)};
        if (entered == 0) {
          at = children.child(i);
          continue;
        }
        stack[top++] = {children.child(i), children.distance(i)};
        do {
          i = static_cast<std::size_t>(std::countr_zero(entered));
          entered &= entered - 1;
          const Distance distance = children.distance(i);
          std::size_t place = top++;
          for (; place > nearest && stack[place - 1].distance <= distance; --place)
            stack[place] = stack[place - 1];
          stack[place] = {children.child(i), distance};
        } while (entered != 0);
        at = stack[--top].node;
        continue;
      }
    } else {
      const AfterLeaf after = visitor.leaf(at.first, at.count);
      if (after == AfterLeaf::stop) return;
      if (after == AfterLeaf::shorter) {
        length = visitor.length();
        children.cut(length);
      }
    }
    do {
      if (top == 0) return;
      --top;
    } while (stack[top].distance > length);
    at = stack[top].node;
  }
}

}  // namespace hitpipe::ref
