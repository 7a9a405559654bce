// What walk_near_first() does at the nodes of a hierarchy when the thesis's counts are wanted.
#pragma once

#include <cstdint>

#include "rays/trace/leaf.hpp"
#include "rays/trace/near_first.hpp"

namespace hitpipe::ref {

/// Tests the triangles of leaves, and counts. All that it is made from must outlive it.
class CountingVisitor {
 public:
  CountingVisitor(const Leaves& leaves, const Ray& ray, Query query, Loads loads)
      : leaves_(leaves), ray_(ray), loads_(loads), query_(query) {}

  void branch(std::uint32_t number, unsigned children) {
    node(number);
    counts_.box_tests += children;
  }
  AfterLeaf leaf(std::uint32_t first, std::int32_t count) {
    const auto triangles = leaves_.triangles(first, count);
    const std::uint32_t before = hit_.triangle;
    const std::uint32_t tests = leaves_.test->ray(*leaves_.mesh, triangles, ray_, query_, hit_);
    loads_.triangles(triangles.first(tests));
    counts_.triangle_tests += tests;
    counts_.triangles_loaded += tests;
    if (hit_.triangle == before) return AfterLeaf::same;
    return query_ == Query::any ? AfterLeaf::stop : AfterLeaf::shorter;
  }
  [[nodiscard]] float length() const { return cull_length(hit_); }

  [[nodiscard]] const Hit& hit() const { return hit_; }
  [[nodiscard]] const TraceCounts& counts() const { return counts_; }

 protected:
  void node(std::uint32_t number) {
    loads_.node(number);
    ++counts_.nodes_loaded;
  }
  TraceCounts counts_{.rays = 1};

 private:
  const Leaves& leaves_;
  const Ray& ray_;
  Loads loads_;
  Query query_;
  Hit hit_;
};

}  // namespace hitpipe::ref
