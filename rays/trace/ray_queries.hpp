// What a scene answers to a ray, in one world or the other: the interface between whoever has rays (the installed
// library, benchmarks) and the fast tracer. Answers depend neither on the hierarchy nor on vectors or threads.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "hls/world/world_format.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/crossing_count.hpp"
#include "rays/trace/vector_width.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

struct IntMesh;
class IntTriangles;

/// How much is found of a nearest hit. Exact numbers take longer than the triangle.
enum class HitDetail : std::uint8_t { triangle, distance, weights };

struct NearestHit {
  std::uint32_t triangle = Hit::none;
  /// In units of the ray's direction. Float world: the exact number, rounded down to a double. Integer world: of T.
  double t = std::numeric_limits<double>::infinity();
  std::array<double, 3> weights{};  ///< of the corners, exact numbers rounded down
};

struct RayCrossing {
  std::uint32_t triangle = Hit::none;
  double t = 0;  ///< as NearestHit::t
  int side = 0;  ///< 1 or -1: the sign of direction . (b - a) x (c - a)
};

/// Thread-safe. Of a ray all that is in its length counts, ends included. It does not see instances whose mask has no bit
/// of `mask`.
class RayQueries {
 public:
  static constexpr std::uint8_t all_masks = 0xff;

  virtual ~RayQueries() = default;
  [[nodiscard]] virtual NearestHit nearest(const Ray& ray, HitDetail detail,
                                           std::uint8_t mask = all_masks) const = 0;
  [[nodiscard]] virtual bool any(const Ray& ray, std::uint8_t mask = all_masks) const = 0;
  [[nodiscard]] virtual CrossingCount count(const Ray& ray, std::uint8_t mask = all_masks) const = 0;
  /// Appends them from near to far; at the same exact t by triangle.
  virtual void all(const Ray& ray, std::vector<RayCrossing>& to, std::uint8_t mask = all_masks) const = 0;
};

/// Corners and rays are finite, with coordinates up to 2^24 in magnitude. The mesh must outlive it, the hierarchy need
/// not. Throws as fast_tracer().
[[nodiscard]] std::unique_ptr<RayQueries> float_queries(const Mesh& mesh, const Bvh& bvh,
                                                        VectorWidth width = VectorWidth::best);

/// Rays are in the cube, and are rounded as int_ray() does. `bvh` is over mesh.mesh; nothing, for a mesh without
/// triangles. Throws as int_tracer().
[[nodiscard]] std::unique_ptr<RayQueries> int_queries(const IntMesh& mesh, const Bvh* bvh,
                                                      const hls::WorldBits& bits,
                                                      VectorWidth width = VectorWidth::best);

/// Of instances, for example.
[[nodiscard]] std::unique_ptr<RayQueries> int_queries(std::shared_ptr<const IntTriangles> triangles,
                                                      const hls::WorldBits& bits);

}  // namespace hitpipe::ref
