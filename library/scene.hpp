// A scene as the C interface holds it.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <shared_mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hitpipe/scene.h"
#include "hls/world/world_format.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/trace/int_fast_scene.hpp"
#include "rays/trace/ray_queries.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/tree/closed.hpp"
#include "rays/world/instances.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/own_instances.hpp"
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

/// A scene of meshes and instances. Whoever asks holds it, and a move waits until nobody does.
struct Instanced {
  Instanced(std::span<const ref::SourceMesh> meshes, std::span<const ref::OwnInstance> instances,
            std::vector<std::uint32_t> its_numbers, const ref::Normalisation& transform,
            const hls::WorldBits& bits, int threads);

  std::vector<std::uint32_t> numbers;  ///< the caller's, by instance
  ref::InstanceGrids grids;
  ref::IntInstances world;
  std::shared_ptr<ref::FastInstances> triangles;
  /// The flattened mesh is closed if each mesh is.
  ref::Closedness closedness;
  std::size_t without_area = 0;
};

/// What is asked, for as long as somebody asks.
class Held {
 public:
  Held(std::shared_ptr<const Placed> placed, std::shared_lock<std::shared_mutex> stays)
      : placed_(std::move(placed)), stays_(std::move(stays)) {}
  const Placed* operator->() const { return placed_.get(); }
  const Placed& operator*() const { return *placed_; }

 private:
  std::shared_ptr<const Placed> placed_;
  std::shared_lock<std::shared_mutex> stays_;
};

struct SceneState {
  std::string world;
  std::optional<hls::WorldBits> bits;  ///< nothing: the float world
  ref::Normalisation transform;        ///< of the float world it moves nothing
  ref::Origins origins;                ///< of rays, in the caller's units
  ref::Bvh tree;                       ///< over all triangles; its boxes are of the first corners
  std::unique_ptr<Instanced> instanced;
  mutable std::shared_mutex instances_stay;

  /// Where it is now. Whoever holds a mesh keeps it, though the scene moves: nobody waits for anybody. Instances stay
  /// while they are held.
  [[nodiscard]] Held placed() const {
    std::shared_lock<std::shared_mutex> stays;
    if (instanced) stays = std::shared_lock(instances_stay);
    const std::scoped_lock lock(placing_);
    return {placed_, std::move(stays)};
  }
  void place(std::shared_ptr<const Placed> there) {
    const std::scoped_lock lock(placing_);
    placed_.swap(there);
  }

 private:
  mutable std::mutex placing_;
  std::shared_ptr<const Placed> placed_;
};

}  // namespace hitpipe::library

struct hitpipe_scene {
  std::shared_ptr<hitpipe::library::SceneState> state;
  std::uint8_t mask = hitpipe::ref::IntInstance::all_masks;  ///< of its rays
};

namespace hitpipe::library {

/// Ray `i` of a caller as the scene's world takes it: in the cube, of an integer world. Throws a Refusal that names the
/// ray.
[[nodiscard]] ref::Ray ray_of_scene(const SceneState& scene, const hitpipe_ray& ray, std::size_t i);

/// A ray that takes_ray() takes, as ray_of_scene() gives it.
[[nodiscard]] ref::Ray in_world(const SceneState& scene, const hitpipe_ray& ray);

/// Whether ray_of_scene() takes the ray, whatever its number.
[[nodiscard]] bool takes_ray(const SceneState& scene, const hitpipe_ray& ray);

/// What t of the world is in the caller's units: the direction stays as it is.
[[nodiscard]] inline double own_t(const SceneState& scene, double t) {
  return t / scene.transform.scale;
}

/// Of NULL or "float" nothing. Throws a Refusal for a world that there is not.
[[nodiscard]] std::optional<hls::WorldBits> chosen_world(const char* world);

/// Throws a Refusal for a number of threads that is not allowed.
[[nodiscard]] int checked_threads(int threads);

/// The caller's hierarchy over so many triangles, without boxes. Throws a Refusal that names the first bad node.
[[nodiscard]] ref::Bvh checked_tree(const hitpipe_hierarchy& hierarchy, std::size_t triangles);

}  // namespace hitpipe::library
