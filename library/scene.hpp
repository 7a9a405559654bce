// A scene as the C interface holds it.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "hitpipe/scene.h"
#include "hls/world/world_format.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/trace/ray_queries.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/tree/closed.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/to_cube.hpp"

namespace hitpipe::library {

/// What follows from where the corners are.
struct Placed {
  ref::Mesh mesh;                        ///< all triangles; binary32 as given, or in the cube
  std::optional<ref::IntMesh> int_mesh;  ///< of an integer world
  std::optional<ref::Bvh> bvh;           ///< over the triangles that have an area there; nothing: none has
  std::vector<std::uint32_t> numbers;    ///< of these triangles, ascending
  std::unique_ptr<ref::RayQueries> queries;  ///< nothing: no triangle has an area

  /// Found when somebody first asks, and thread-safe.
  [[nodiscard]] const ref::Closedness& closedness() const;

 private:
  mutable std::mutex finding_;
  mutable std::optional<ref::Closedness> closedness_;
};

}  // namespace hitpipe::library

struct hitpipe_scene {
  std::string world;
  std::optional<hitpipe::hls::WorldBits> bits;  ///< nothing: the float world
  hitpipe::ref::Normalisation transform;        ///< of the float world it moves nothing
  hitpipe::ref::Origins origins;                ///< of rays, in the caller's units
  hitpipe::ref::Bvh tree;                       ///< over all triangles; its boxes are of the first corners

  /// Where it is now. Whoever holds that keeps it, though the scene moves: nobody waits for anybody.
  [[nodiscard]] std::shared_ptr<const hitpipe::library::Placed> placed() const {
    const std::scoped_lock lock(placing_);
    return placed_;
  }
  void place(std::shared_ptr<const hitpipe::library::Placed> there) {
    const std::scoped_lock lock(placing_);
    placed_.swap(there);
  }

 private:
  mutable std::mutex placing_;
  std::shared_ptr<const hitpipe::library::Placed> placed_;
};

namespace hitpipe::library {

/// Ray `i` of a caller as the scene's world takes it: in the cube, of an integer world. Throws a Refusal that names the
/// ray.
[[nodiscard]] ref::Ray ray_of_scene(const hitpipe_scene& scene, const hitpipe_ray& ray, std::size_t i);

/// A ray that takes_ray() takes, as ray_of_scene() gives it.
[[nodiscard]] ref::Ray in_world(const hitpipe_scene& scene, const hitpipe_ray& ray);

/// Whether ray_of_scene() takes the ray, whatever its number.
[[nodiscard]] bool takes_ray(const hitpipe_scene& scene, const hitpipe_ray& ray);

/// What t of the world is in the caller's units: the direction stays as it is.
[[nodiscard]] inline double own_t(const hitpipe_scene& scene, double t) {
  return t / scene.transform.scale;
}

/// Throws a Refusal for a number of threads that is not allowed.
[[nodiscard]] int checked_threads(int threads);

/// The caller's hierarchy over so many triangles, without boxes. Throws a Refusal that names the first bad node.
[[nodiscard]] ref::Bvh checked_tree(const hitpipe_hierarchy& hierarchy, std::size_t triangles);

}  // namespace hitpipe::library
