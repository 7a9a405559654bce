// Rays in, triangles out: the interface between code that makes rays (renderer, experiments) and code that
// traces them. With the exact triangle test all tracers give the same answers (docs/never_misses.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "hls/box/int_format.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

/// The question that a ray answers.
enum class Query : std::uint8_t {
  closest,  ///< the nearest triangle, ties to the lower index
  any,      ///< stop at the first triangle found: only blocked or not blocked counts
};

/// Whether a ray's answer is the right one. Triangles are those of TraceJob, or their numbers.
[[nodiscard]] inline bool same_answer(Query query, std::uint32_t triangle, std::uint32_t right) {
  if (query == Query::closest) return triangle == right;
  return (triangle == Hit::none) == (right == Hit::none);
}

/// The work of tracing. A load is one fetch of a node or triangle, for any number of rays. For single rays
/// loads equal tests; for bundles there are fewer loads (section 5.6).
struct TraceCounts {
  std::uint64_t rays = 0;
  std::uint64_t box_tests = 0;
  std::uint64_t triangle_tests = 0;
  std::uint64_t nodes_loaded = 0;
  std::uint64_t triangles_loaded = 0;

  TraceCounts& operator+=(const TraceCounts& other) {
    rays += other.rays;
    box_tests += other.box_tests;
    triangle_tests += other.triangle_tests;
    nodes_loaded += other.nodes_loaded;
    triangles_loaded += other.triangles_loaded;
    return *this;
  }
  friend bool operator==(const TraceCounts&, const TraceCounts&) = default;

  /// A ray that is traced alone: what it tests is loaded for it.
  [[nodiscard]] static TraceCounts of_ray(std::uint64_t box_tests, std::uint64_t triangle_tests) {
    return {1, box_tests, triangle_tests, box_tests, triangle_tests};
  }
};

/// Is told of each load of a node (its number in the tracer's store) or triangle (its number in the mesh), in
/// order.
class LoadObserver {
 public:
  virtual ~LoadObserver() = default;
  virtual void node_loaded(std::uint32_t node) = 0;
  virtual void triangle_loaded(std::uint32_t triangle) = 0;
};

/// Rays to trace, and places for the answers.
struct TraceJob {
  std::span<const Ray> rays;
  Query query = Query::closest;
  /// One for each ray: the triangle that the ray hits, or Hit::none. With Query::any it is some triangle that
  /// the ray hits.
  std::span<std::uint32_t> triangles;
  /// The tests of each ray, or empty if they are not needed.
  std::span<TraceCounts> work = {};
  LoadObserver* loads = nullptr;  ///< null: nobody watches
};

/// How nodes and triangles lie in memory, for a tracer that needs them to lie in a certain way.
struct MemoryOrder {
  std::span<const std::uint32_t> triangles{};  ///< all, one after the other; empty: Bvh::order
  /// By node: triangles that lie before it in the array that holds both. Nodes lie by number. Empty: nodes
  /// and triangles have arrays of their own.
  std::span<const std::uint32_t> triangles_before{};
};

/// Thread-safe. Its hierarchy and mesh must outlive it and not change.
class Tracer {
 public:
  virtual ~Tracer() = default;

  /// Adds to `counts`. Rays must be acceptable() (rays/exact/box_referee.hpp).
  virtual void trace(const TraceJob& job, TraceCounts& counts) const = 0;

  [[nodiscard]] virtual std::size_t bytes_per_node() const = 0;
  [[nodiscard]] virtual std::size_t node_count() const = 0;
  [[nodiscard]] virtual MemoryOrder memory_order() const { return {}; }
};

/// Box test and order of the children (chapter 4).
enum class Algorithm : std::uint8_t {
  slabs,       ///< BVH-Slabs: child 0, then child 1 (section 4.4)
  plu,         ///< BVH-Plu
  slabs_dist,  ///< BVH-Slabs-Dist: nearer box first (section 4.5)
  slabs_dsa,   ///< BVH-Slabs-DSA: by direction and split axis
  plu_dsa,     ///< BVH-Plu-DSA
};

enum class Arithmetic : std::uint8_t {
  binary32,      ///< as the thesis computes; never misses a triangle in a padded box
  binary64,      ///< section 5.7
  conservative,  ///< binary32 slabs widened by a proven bound: never misses a box, padded or not
  integer,       ///< chapter 6, n/t bits: integer slabs or Pluecker as the algorithm says
};

enum class Encoding : std::uint8_t {
  plain,  ///< 32 bytes a node; 56 with binary64; 20, 23, 26 with integers of 16, 20, 24 bits (Table 6.1)
  hierarchical_4,  ///< 8 bytes a node, relative to the quantised parent (section 5.2)
  hierarchical_8,  ///< 12 bytes
  hierarchical_12,
  hierarchical_16,
  wide4,        ///< 64 bytes a node of 4 children with 8-bit planes (rays/tree/wide_node.hpp)
  wide8,        ///< 80 bytes a node of 8: CWBVH
  wide4_float,  ///< 128 bytes: the tree of wide4 in binary32
  wide8_float,  ///< 256 bytes
  pair6,        ///< 12 bytes for two children, planes of 8 bits (sw_ref/hierarchy/compact_pairs.hpp)
  pair8,        ///< 16 bytes, planes of 13 bits
  pair10,       ///< 20 bytes, planes of 18 bits
};

enum class TriangleTest : std::uint8_t {
  exact,     ///< rays/exact: one answer for every traversal
  binary32,  ///< Moeller and Trumbore (1997), as in the thesis, for its timings
  binary64,
};

/// Chooses one of the tracers of the thesis. The tracers of other box tests are made by store_tracer().
struct TracerOptions {
  Algorithm algorithm = Algorithm::slabs_dsa;
  Arithmetic arithmetic = Arithmetic::conservative;
  Encoding encoding = Encoding::plain;
  bool look_up_table = false;  ///< integer-to-float conversion by table; hierarchical 4 and 8 bits only
  int bundle = 1;              ///< the most rays traced together: 1, 64 or 256 (section 5.5)
  hls::IntBits bits{24, 24};   ///< of integer arithmetic
  TriangleTest triangle_test = TriangleTest::exact;
};

/// Encodes the nodes and picks the traversal loop. Throws std::invalid_argument, one line, when there is no
/// such tracer, and std::out_of_range for boxes that leave the grid.
[[nodiscard]] std::unique_ptr<Tracer> make_tracer(const Mesh& mesh, const Bvh& bvh,
                                                  const TracerOptions& options);

}  // namespace hitpipe::ref
