// Traces rays of one direction class together (section 5.5). A node is loaded once, and its box is tested
// with all rays that hit its parent. A leaf's triangles are loaded once and tested with all rays that hit its
// box. Each ray has as many tests as if it were traced alone.
#pragma once

#include <array>
#include <concepts>
#include <span>

#include "sw_ref/trace/traversal.hpp"

namespace hitpipe::ref {

constexpr int largest_bundle = 256;

/// Box tests that mirror the box. The mirrored box is the same for all rays of a direction class.
template <class Test, class Box>
concept BundleBoxTest = requires(const Test& test, const Box& box) {
  { test.meets(test.mirror()(box)) } -> std::same_as<bool>;
};

template <class Store, class Test>
class BundleTrace {
 public:
  /// `tests[i]` is the test of `rays[i]`. There are 1 to largest_bundle rays, all of one class. All have a
  /// place for their own work, or none has.
  BundleTrace(const Store& store, const Leaves& leaves, Query query, std::span<BundledRay> rays, Test* tests,
              Loads loads)
      : store_(store), leaves_(leaves), query_(query), rays_(rays), tests_(tests), loads_(loads) {}

  void run(unsigned order_class, TraceCounts& counts) {
    struct Sibling {
      Waiting<Store> node;
      std::uint32_t first, last;  // of numbers_: the rays that hit the parent
    };
    std::array<Sibling, deepest_stack> stack;
    std::size_t top = 0;
    const auto all = static_cast<std::uint32_t>(rays_.size());
    for (std::uint32_t i = 0; i < all; ++i) numbers_[i] = static_cast<std::uint16_t>(i);
    typename Store::Node node = store_.root();
    std::uint32_t first = 0;
    std::uint32_t last = all;
    for (;;) {
      const std::uint32_t hit_end = test_box(node, first, last, counts);
      if (hit_end != last) {
        const std::int32_t count = store_.count(node);
        first = last;
        last = hit_end;
        if (count < 0) {
          const unsigned near = near_child(order_class, -1 - count);
          stack[top++] = {Waiting<Store>(store_, node, near ^ 1U), first, last};
          node = store_.child(node, near);
          continue;
        }
        test_leaf(store_.first(node), count, first, last, counts);
      }
      do {
        if (top == 0) return;
        const Sibling& sibling = stack[--top];
        node = sibling.node.load(store_);
        first = sibling.first;
        last = query_ == Query::any ? drop_blocked(first, sibling.last) : sibling.last;
      } while (first == last);
    }
  }

 private:
  /// Lists the rays that hit the node's box from `last` on; returns the end of that list.
  std::uint32_t test_box(const typename Store::Node& node, std::uint32_t first, std::uint32_t last,
                         TraceCounts& counts) {
    loads_.node(store_.index(node));
    ++counts.nodes_loaded;
    counts.box_tests += last - first;
    const auto box = tests_[0].mirror()(store_.box(node));
    if (rays_[0].work != nullptr) {
      for (std::uint32_t i = first; i < last; ++i) ++rays_[numbers_[i]].work->box_tests;
    }
    std::uint32_t end = last;
    for (std::uint32_t i = first; i < last; ++i) {
      const std::uint16_t number = numbers_[i];
      numbers_[end] = number;
      end += tests_[number].meets(box) ? 1 : 0;
    }
    return end;
  }

  void test_leaf(std::uint32_t first_triangle, std::int32_t count, std::uint32_t first, std::uint32_t last,
                 TraceCounts& counts) {
    const auto triangles = leaves_.triangles(first_triangle, count);
    const std::span<std::uint16_t> numbers(&numbers_[first], last - first);
    const LeafCounts tests = leaves_.test->bundle(*leaves_.mesh, triangles, rays_.data(), numbers, query_);
    loads_.triangles(triangles.first(tests.loaded));
    counts.triangles_loaded += tests.loaded;
    counts.triangle_tests += tests.tests;
    if (query_ == Query::any) return;
    for (const std::uint16_t number : numbers) {
      BundledRay& ray = rays_[number];
      if (ray.hit.triangle == ray.cut_at) continue;
      ray.cut_at = ray.hit.triangle;
      tests_[number].cut(cull_length(ray.hit));
    }
  }

  /// The second child is the last to read a list, so blocked rays can leave it for good.
  std::uint32_t drop_blocked(std::uint32_t first, std::uint32_t last) {
    std::uint32_t end = first;
    for (std::uint32_t i = first; i < last; ++i) {
      const std::uint16_t number = numbers_[i];
      numbers_[end] = number;
      end += rays_[number].hit.found() ? 0 : 1;
    }
    return end;
  }

  const Store& store_;
  const Leaves& leaves_;
  Query query_;
  std::span<BundledRay> rays_;
  Test* tests_;
  Loads loads_;
  // For each node on the path to the current one, the list of rays that hit it, one list after the other. The
  // array is not initialised, because a list is written before it is read.
  std::array<std::uint16_t, std::size_t{BuildOptions::deepest + 1} * largest_bundle> numbers_;
};

}  // namespace hitpipe::ref
