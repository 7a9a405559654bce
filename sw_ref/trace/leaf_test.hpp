// Tests the triangles of a leaf with one ray or the rays of a bundle, by any of the triangle tests. It is a
// table of two functions, so the traversal loops are compiled only once.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "sw_ref/judge/triangle_test.hpp"
#include "sw_ref/scene/mesh.hpp"
#include "sw_ref/scene/ray.hpp"
#include "sw_ref/trace/query.hpp"
#include "sw_ref/trace/tracer.hpp"

namespace hitpipe::ref {

/// A ray of a bundle, and its result so far.
struct BundledRay {
  Ray ray;
  Hit hit;
  RayWork work;
  std::uint32_t cut_at = Hit::none;  ///< the hit whose distance its box test was cut to

  explicit BundledRay(const Ray& its_ray) : ray(its_ray) {}
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

}  // namespace hitpipe::ref
