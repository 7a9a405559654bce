// Wide nodes and triangles by four, made once from a hierarchy, and the fast walk over them. It knows neither what a
// ray asks nor in which world: a sink is told of the triangles that a ray may hit.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "rays/mesh/aabb.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/fast_tracer.hpp"
#include "rays/trace/fast_walk.hpp"
#include "rays/tree/bvh.hpp"

namespace hitpipe::ref {

/// Thread-safe.
class FastScene {
 public:
  virtual ~FastScene() = default;

  /// The sink is told of every triangle that the ray hits within its length and the sink's. Origin and length are those
  /// of the exact ray, or these are rounded: `reach` then is largest_reach() with an allowance.
  virtual void walk(const Ray& ray, float reach, FastSink& sink, FastWork& work) const = 0;
  /// The same for corners that are moved, of integers: the sink is told of triangles as they are in the world.
  virtual void walk(const PlacedRay& ray, FastSink& sink) const = 0;
  [[nodiscard]] virtual std::size_t bytes_per_node() const = 0;
  [[nodiscard]] virtual std::size_t node_count() const = 0;

  /// No coordinate of a corner is farther from the ray's origin, but for roundings.
  [[nodiscard]] float largest_reach(const Ray& ray) const {
    const glm::vec3& o = ray.origin;
    return largest_corner_ + std::max({std::fabs(o.x), std::fabs(o.y), std::fabs(o.z)});
  }

 protected:
  float largest_corner_ = 0;  ///< of coordinates, in magnitude
};

/// Corners by triangle. What a hierarchy has beyond its boxes and triangles is not read. Throws as fast_tracer().
[[nodiscard]] std::unique_ptr<FastScene> fast_scene(
    const Bvh& bvh, const std::function<Mesh::Corners(std::uint32_t)>& corners, VectorWidth width);

/// Boxes alone. Thread-safe, but for refit().
class FastBoxes {
 public:
  virtual ~FastBoxes() = default;

  /// Tells the sink of every entry of Bvh::order whose leaf's box the ray meets.
  virtual void walk(const Ray& ray, FastBoxSink& sink) const = 0;
  /// New boxes of these entries, and what follows for those above. box(entry) gives any entry's box.
  virtual void refit(std::span<const std::uint32_t> entries,
                     const std::function<Aabb(std::uint32_t)>& box) = 0;
};

/// Throws as fast_tracer().
[[nodiscard]] std::unique_ptr<FastBoxes> fast_boxes(const Bvh& bvh, VectorWidth width);

}  // namespace hitpipe::ref
