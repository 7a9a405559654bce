// Tests the triangles of a leaf with one ray or the rays of a bundle, by any of the triangle tests. It is a
// table of two functions, so the traversal loops are compiled only once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "rays/exact/exact_triangle.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/tracer.hpp"

namespace hitpipe::ref {

/// Throws std::invalid_argument unless there are as many places for answers, and for work if any, as rays.
void check_places(const TraceJob& job);

/// A ray of a bundle, and its result so far.
struct BundledRay {
  Ray ray;
  Hit hit;
  TraceCounts* work;                 ///< of this ray alone, or null
  std::uint32_t cut_at = Hit::none;  ///< the hit whose distance its box test was cut to

  BundledRay(const Ray& its_ray, TraceCounts* its_work) : ray(its_ray), work(its_work) {}
};

/// Numbers of rays of a bundle.
using RayNumbers = std::span<std::uint16_t>;

struct LeafCounts {
  std::uint64_t tests = 0;
  std::uint32_t loaded = 0;  ///< the first so many triangles of the leaf
};

struct LeafTest {
  /// Tests the triangles in order, with Query::any up to the first hit. Returns how many were tested.
  std::uint32_t (*ray)(const Mesh& mesh, std::span<const std::uint32_t> triangles, const Ray& ray,
                       Query query, Hit& best);
  /// Each triangle is loaded once and tested with all rays in `numbers`. With Query::any a ray leaves
  /// `numbers` when it hits a triangle.
  LeafCounts (*bundle)(const Mesh& mesh, std::span<const std::uint32_t> triangles, BundledRay* rays,
                       RayNumbers numbers, Query query);
};

[[nodiscard]] const LeafTest& leaf_test(TriangleTest test);

/// The triangles of a hierarchy, leaf by leaf, and how to test them.
struct Leaves {
  const Mesh* mesh;
  std::span<const std::uint32_t> order;
  const LeafTest* test;

  Leaves(const Mesh& its_mesh, const Bvh& bvh, TriangleTest its_test = TriangleTest::exact)
      : mesh(&its_mesh), order(bvh.order), test(&leaf_test(its_test)) {}

  [[nodiscard]] std::span<const std::uint32_t> triangles(std::uint32_t first, std::int32_t count) const {
    return order.subspan(first, static_cast<std::size_t>(count));
  }
};

/// Tells whoever watches.
struct Loads {
  LoadObserver* observer = nullptr;

  void node(std::uint32_t node) const {
    if (observer != nullptr) observer->node_loaded(node);
  }
  void triangles(std::span<const std::uint32_t> triangles) const {
    if (observer == nullptr) return;
    for (const std::uint32_t triangle : triangles) observer->triangle_loaded(triangle);
  }
};

}  // namespace hitpipe::ref
