// Rays in, triangles out: the one seam between those who make rays (renderer, experiments) and those who
// trace them. Which box test, node encoding, child order, precision and bundle size a tracer stands for is
// chosen when it is made; with the exact triangle test all of them give the same answers
// (docs/one_answer.md).
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "hls/box/int_format.hpp"
#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/geometry/ray.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/scene/mesh.hpp"
#include "sw_ref/traverse/query.hpp"

namespace hitpipe::ref {

/// What tracing took. A load is one fetch of a node or triangle, for however many rays it serves: for single
/// rays loads equal tests, for bundles they are fewer (section 5.6).
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
};

/// The work for one ray, for heat maps.
struct RayWork {
  std::uint32_t box_tests = 0;
  std::uint32_t triangle_tests = 0;
};

/// Rays to trace and the places for the answers.
struct TraceJob {
  std::span<const Ray> rays;
  Query query = Query::closest;
  /// As long as `rays`: the triangle that a ray hits, Hit::none if none. With Query::any, some triangle.
  std::span<std::uint32_t> triangles;
  /// As long as `rays`, or empty when nobody asks.
  std::span<RayWork> work = {};
};

/// Thread-safe; hierarchy and mesh that it was made for must outlive it unchanged.
class Tracer {
 public:
  virtual ~Tracer() = default;

  /// Adds to `counts`. Rays must be acceptable() (sw_ref/quantise/ray_check.hpp).
  virtual void trace(const TraceJob& job, TraceCounts& counts) const = 0;

  [[nodiscard]] virtual std::size_t bytes_per_node() const = 0;
  [[nodiscard]] virtual std::size_t node_count() const = 0;
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
  binary32,  ///< as the thesis computes; on padded boxes never misses a triangle
  binary64,  ///< section 5.7
  robust,    ///< binary32 slabs widened by a proven bound: never misses a box, padded or not. Not for plu
  integer,   ///< chapter 6, n/t bits: integer slabs or integer Pluecker, by the algorithm; not slabs_dist
};

enum class Encoding : std::uint8_t {
  plain,           ///< 32 bytes a node; 56 with binary64; 20, 23, 26 with integer 16, 20, 24 bits (Table 6.1)
  hierarchical_4,  ///< 8 bytes a node, relative to the quantised parent (section 5.2)
  hierarchical_8,  ///< 12 bytes
  hierarchical_12,
  hierarchical_16,
};

enum class TriangleTest : std::uint8_t {
  exact,     ///< sw_ref/exact: one answer for every traversal
  binary32,  ///< Moeller and Trumbore (1997), as the thesis; for its timings
  binary64,
};

struct TracerOptions {
  Algorithm algorithm = Algorithm::slabs_dsa;
  Arithmetic arithmetic = Arithmetic::robust;
  Encoding encoding = Encoding::plain;
  bool look_up_table = false;  ///< integer-to-float conversion by table; hierarchical 4 and 8 bits only
  int bundle = 1;  ///< rays traced together at most: 1, 64 or 256 (section 5.5); 1 with integer, slabs_dist
  hls::IntBits bits{24, 24};  ///< of integer arithmetic
  TriangleTest triangle_test = TriangleTest::exact;
  CoarseAxes coarse{};  ///< of integer arithmetic; rays and boxes must fit the coarser grid
  bool ends = true;     ///< box tests hear where rays end; without, all but slabs_dist and only single rays
};

/// Encodes the nodes and picks the loop. Throws std::invalid_argument, one line, for a combination that does
/// not exist (see the comments above), std::out_of_range for boxes that leave the grid.
[[nodiscard]] std::unique_ptr<Tracer> make_tracer(const Mesh& mesh, const Bvh& bvh,
                                                  const TracerOptions& options);

}  // namespace hitpipe::ref
