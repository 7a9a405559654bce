// What a scene of the C interface is asked.
#include <algorithm>
#include <atomic>
#include <limits>
#include <span>
#include <vector>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "host/watch.hpp"
#include "library/failure.hpp"
#include "library/scene.hpp"
#include "library/shapes.hpp"

namespace hitpipe::library {

namespace {

/// Rays that a thread takes at a time.
constexpr std::size_t block = 1024;
/// Rays between two looks at the thread's watch. One that crosses much takes milliseconds.
constexpr std::size_t rays_between_looks = 16;

/// Calls ask(ray, i) for each ray. Before the first call all rays are checked; a Refusal names the first bad one.
template <class Ask>
void ask_each(const SceneState& scene, std::span<const hitpipe_ray> rays, int threads, const Ask& ask) {
  host::with_threads(checked_threads(threads), [&] {
    std::atomic<std::size_t> bad = rays.size();
    host::for_each_block(0, rays.size(), block, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last && i < bad; ++i) {
        if (takes_ray(scene, rays[i])) continue;
        for (std::size_t before = bad; i < before && !bad.compare_exchange_weak(before, i);) continue;
      }
    });
    if (bad < rays.size()) static_cast<void>(ray_of_scene(scene, rays[bad], bad));
    std::atomic<bool> ends = false;
    const auto look = [&] {
      try {
        host::look();
      } catch (...) {
        ends = true;
        throw;
      }
    };
    host::for_each_block(0, rays.size(), block, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i < last && !ends.load(std::memory_order_relaxed); ++i) {
        if (i % rays_between_looks == 0) look();
        ask(in_world(scene, rays[i]), i);
      }
    });
  });
}

/// The triangle's number in the caller's mesh.
std::uint32_t number_of(const Placed& placed, std::uint32_t triangle) {
  if (triangle == ref::Hit::none) return HITPIPE_NO_TRIANGLE;
  return placed.numbers.empty() ? triangle : placed.numbers[triangle];
}

void store(const SceneState& scene, const Placed& placed, const ref::NearestHit& hit,
           const hitpipe_nearest_out& out, std::size_t i) {
  if (out.triangle != nullptr) out.triangle[i] = number_of(placed, hit.triangle);
  if (out.t != nullptr) out.t[i] = own_t(scene, hit.t);
  if (out.weights != nullptr) std::copy(hit.weights.begin(), hit.weights.end(), out.weights + 3 * i);
}

/// A ray that begins at the point. Any direction would do: what is inside is the point's alone.
hitpipe_ray from_point(const float* point) {
  return {{point[0], point[1], point[2]}, {1.0F, 0.0F, 0.0F}, std::numeric_limits<float>::infinity()};
}

}  // namespace

}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_nearest(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                               int threads, const hitpipe_nearest_out* out) {
  return guarded([&] {
    using hitpipe::ref::HitDetail;
    const auto placed = given(scene, "scene").state->placed();
    const hitpipe::ref::RayQueries* const queries = placed->queries.get();
    const hitpipe_nearest_out places = given(out, "out");
    const HitDetail detail = places.weights != nullptr ? HitDetail::weights
                             : places.t != nullptr     ? HitDetail::distance
                                                       : HitDetail::triangle;
    ask_each(
        *scene->state, given(rays, ray_count), threads, [&](const hitpipe::ref::Ray& ray, std::size_t i) {
          const auto hit =
              queries == nullptr ? hitpipe::ref::NearestHit{} : queries->nearest(ray, detail, scene->mask);
          store(*scene->state, *placed, hit, places, i);
        });
  });
}

hitpipe_status hitpipe_any(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count, int threads,
                           uint8_t* met) {
  return guarded([&] {
    const auto placed = given(scene, "scene").state->placed();
    const hitpipe::ref::RayQueries* const queries = placed->queries.get();
    if (ray_count != 0) static_cast<void>(given(met, "met"));
    ask_each(*scene->state, given(rays, ray_count), threads,
             [&](const hitpipe::ref::Ray& ray, std::size_t i) {
               met[i] = queries != nullptr && queries->any(ray, scene->mask) ? 1 : 0;
             });
  });
}

hitpipe_status hitpipe_count(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                             int threads, uint32_t* crossings, int32_t* sides) {
  return guarded([&] {
    const auto placed = given(scene, "scene").state->placed();
    const hitpipe::ref::RayQueries* const queries = placed->queries.get();
    ask_each(*scene->state, given(rays, ray_count), threads,
             [&](const hitpipe::ref::Ray& ray, std::size_t i) {
               const auto count =
                   queries == nullptr ? hitpipe::ref::CrossingCount{} : queries->count(ray, scene->mask);
               if (crossings != nullptr) crossings[i] = static_cast<uint32_t>(count.crossings);
               if (sides != nullptr) sides[i] = static_cast<int32_t>(count.sides);
             });
  });
}

hitpipe_status hitpipe_all(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count, int threads,
                           const hitpipe_all_out* out) {
  return guarded([&] {
    const auto placed = given(scene, "scene").state->placed();
    const hitpipe_all_out places = given(out, "out");
    uint64_t* const offsets = &given(places.offsets, "offsets");
    std::vector<std::vector<hitpipe::ref::RayCrossing>> found(ray_count);
    ask_each(*scene->state, given(rays, ray_count), threads,
             [&](const hitpipe::ref::Ray& ray, std::size_t i) {
               if (placed->queries) placed->queries->all(ray, found[i], scene->mask);
             });
    offsets[0] = 0;
    for (std::size_t i = 0; i < ray_count; ++i) offsets[i + 1] = offsets[i] + found[i].size();
    if (offsets[ray_count] > places.capacity) return;
    for (std::size_t i = 0; i < ray_count; ++i) {
      for (std::size_t k = 0; k < found[i].size(); ++k) {
        const std::size_t at = offsets[i] + k;
        if (places.triangle != nullptr) places.triangle[at] = number_of(*placed, found[i][k].triangle);
        if (places.t != nullptr) places.t[at] = own_t(*scene->state, found[i][k].t);
        if (places.side != nullptr) places.side[at] = static_cast<int8_t>(found[i][k].side);
      }
    }
  });
}

hitpipe_status hitpipe_inside(const hitpipe_scene* scene, const float* points, size_t point_count,
                              int threads, uint8_t* inside) {
  return guarded([&] {
    const auto placed = given(scene, "scene").state->placed();
    const hitpipe::ref::RayQueries* const queries = placed->queries.get();
    const hitpipe::ref::Closedness& closedness =
        scene->state->instanced ? scene->state->instanced->closedness : placed->closedness();
    if (!closedness.even())
      throw Refusal(HITPIPE_NOT_CLOSED,
                    fmt::format("the mesh is not closed: {} of its {} edges have an odd number of triangles",
                                closedness.odd, closedness.edges));
    if (point_count != 0) {
      static_cast<void>(given(points, "points"));
      static_cast<void>(given(inside, "inside"));
    }
    std::vector<hitpipe_ray> rays;
    rays.reserve(point_count);
    for (std::size_t i = 0; i < point_count; ++i) rays.push_back(from_point(points + 3 * i));
    ask_each(*scene->state, rays, threads, [&](const hitpipe::ref::Ray& ray, std::size_t i) {
      inside[i] = queries != nullptr && queries->count(ray, scene->mask).inside() ? 1 : 0;
    });
  });
}
