// Scenes of the C interface: made, described, moved.
#include "library/scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <span>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "host/format.hpp"
#include "host/parallel.hpp"
#include "host/text.hpp"
#include "library/failure.hpp"
#include "library/mesh.hpp"
#include "library/transform.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/tree/refit.hpp"
#include "rays/world/to_cube.hpp"

namespace hitpipe::library {

namespace {

constexpr std::string_view float_world = "float";

/// Over all triangles. Of an integer world it is the hierarchy of a core's image.
ref::Bvh built(const SceneState& scene, const Placed& placed, int threads) {
  if (placed.mesh.triangles.empty()) return {};
  ref::BuildOptions options = ref::surface_area_build;
  options.padding = 0.0F;
  options.threads = threads;
  ref::Mesh mesh;
  mesh.triangles = placed.mesh.triangles;
  if (scene.bits) {
    mesh.vertices = placed.int_mesh->mesh.vertices;
    return ref::build_bvh(mesh, options);
  }
  // Units are the caller's, and areas of small ones would underflow. A hierarchy depends on no power of two.
  options.min_split = 0.0F;
  float largest = 0;
  for (const glm::vec3& vertex : placed.mesh.vertices)
    for (int axis = 0; axis < 3; ++axis) largest = std::max(largest, std::abs(vertex[axis]));
  const int exponent = largest > 0 ? -std::ilogb(largest) : 0;
  for (const glm::vec3& vertex : placed.mesh.vertices)
    mesh.vertices.emplace_back(std::ldexp(vertex.x, exponent), std::ldexp(vertex.y, exponent),
                               std::ldexp(vertex.z, exponent));
  return ref::build_bvh(mesh, options);
}

/// The mesh is in the scene's world, and has no queries yet.
std::unique_ptr<Placed> on_its_grid(const SceneState& scene, ref::Mesh mesh) {
  auto made = std::make_unique<Placed>();
  made->mesh = std::move(mesh);
  if (!scene.bits) {
    made->numbers.resize(made->mesh.triangles.size());
    std::iota(made->numbers.begin(), made->numbers.end(), 0U);
    return made;
  }
  made->int_mesh = ref::int_mesh(made->mesh, scene.bits->coord);
  const ref::TriangleNumbers numbers(made->int_mesh->mesh);
  for (std::uint32_t i = 0; i < made->int_mesh->triangles.size(); ++i)
    made->numbers.push_back(numbers.of_source(i));
  return made;
}

void add_queries(const SceneState& scene, Placed& placed) {
  if (placed.numbers.empty()) return;
  placed.bvh =
      ref::refitted(scene.tree, placed.int_mesh ? placed.int_mesh->mesh : placed.mesh, placed.numbers);
  placed.queries = placed.int_mesh ? ref::int_queries(*placed.int_mesh, &*placed.bvh, *scene.bits)
                                   : ref::float_queries(placed.mesh, *placed.bvh);
}

/// Of a ray that takes_ray() refuses.
std::string why_refused(const SceneState& scene, const hitpipe_ray& ray) {
  for (int axis = 0; axis < 3; ++axis) {
    const char name = "xyz"[axis];
    if (!(std::abs(ray.origin[axis]) <= most_coordinate))
      return fmt::format("origin.{} = {}; allowed is -2^24 to 2^24", name, ray.origin[axis]);
    if (!std::isfinite(ray.direction[axis]))
      return fmt::format("direction.{} = {}; components must be finite", name, ray.direction[axis]);
  }
  if (ray.direction[0] == 0 && ray.direction[1] == 0 && ray.direction[2] == 0)
    return "direction is (0, 0, 0); one component must differ from 0";
  if (!(ray.length >= 0.0F)) return fmt::format("length = {}; it must be >= 0 or infinite", ray.length);
  const glm::vec3 origin = in_world(scene, ray).origin;
  return fmt::format("its origin is ({}, {}, {}) in the cube of the integer world; allowed is [-1, 1]",
                     origin.x, origin.y, origin.z);
}

std::size_t without_area(const Placed& scene) {
  if (scene.int_mesh) return scene.int_mesh->mesh.dropped.size();
  std::size_t count = 0;
  for (std::uint32_t i = 0; i < scene.mesh.triangles.size(); ++i)
    if (!ref::has_area(scene.mesh.corners(i))) ++count;
  return count;
}

}  // namespace

std::optional<hls::WorldBits> chosen_world(const char* world) {
  if (world == nullptr || world == float_world) return std::nullopt;
  const auto& family = family_of<hls::WorldBits>;
  if (const auto numbers = family.parse(world); numbers && family.valid(*numbers)) {
    const auto bits = Format(family, *numbers).as<hls::WorldBits>();
    // What a triangle unit says more than HIT.
    if (bits.weights == 0 && bits.crossings == 0) return bits;
  }
  throw Refusal(HITPIPE_BAD_FORMAT,
                fmt::format("world {}: allowed is \"float\", or n+gsS or n+gsStF with n in {}..{}, g in "
                            "0..{}, S in {}..{} and F in 1..{}, for example \"20+1s20\"",
                            host::shortened(world), hls::WorldBits::min_coord, hls::WorldBits::max_coord,
                            hls::WorldBits::max_finer, hls::WorldBits::min_slope, hls::WorldBits::max_slope,
                            hls::WorldBits::max_fraction));
}

const ref::Closedness& Placed::closedness() const {
  const std::scoped_lock lock(finding_);
  if (!closedness_) closedness_ = int_mesh ? ref::closedness(*int_mesh) : ref::closedness(mesh);
  return *closedness_;
}

ref::Ray in_world(const SceneState& scene, const hitpipe_ray& ray) {
  const glm::vec3 origin(ray.origin[0], ray.origin[1], ray.origin[2]);
  const glm::vec3 direction(ray.direction[0], ray.direction[1], ray.direction[2]);
  if (!scene.bits) return {origin, direction, ray.length};
  return ref::ray_to_cube(glm::dvec3(origin), glm::dvec3(direction), ray.length, scene.transform);
}

bool takes_ray(const SceneState& scene, const hitpipe_ray& ray) {
  bool good = ray.length >= 0.0F && scene.origins.hold({ray.origin[0], ray.origin[1], ray.origin[2]});
  bool moves = false;
  for (const float component : ray.direction) {
    good = good && std::isfinite(component);
    moves = moves || component != 0.0F;
  }
  return good && moves;
}

int checked_threads(int threads) {
  if (threads < 0 || threads > host::most_threads)
    throw Refusal(HITPIPE_BAD_ARGUMENT, fmt::format("{} threads; allowed are 1 to {}, or 0 for one a core",
                                                    threads, host::most_threads));
  return threads;
}

ref::Ray ray_of_scene(const SceneState& scene, const hitpipe_ray& ray, std::size_t i) {
  if (!takes_ray(scene, ray))
    throw Refusal(HITPIPE_BAD_RAY, fmt::format("ray {}: {}", i, why_refused(scene, ray)));
  return in_world(scene, ray);
}

}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_scene_open(const hitpipe_mesh* mesh, const hitpipe_scene_options* options,
                                  hitpipe_scene** out) {
  return guarded([&] {
    static_cast<void>(given(out, "out"));
    const hitpipe_scene_options chosen = options == nullptr ? hitpipe_scene_options{} : *options;
    auto scene = std::make_shared<SceneState>();
    scene->bits = chosen_world(chosen.world);
    scene->world = scene->bits ? hitpipe::to_string(hitpipe::Format(*scene->bits)) : float_world;
    if (!scene->bits && chosen.transform != nullptr)
      throw Refusal(HITPIPE_BAD_ARGUMENT,
                    "transform: the float world has none; rays and corners are in your units");
    CheckedMesh own = checked_mesh(given(mesh, "mesh"));
    const int threads = checked_threads(chosen.threads);
    scene->origins = {glm::vec3(-most_coordinate), glm::vec3(most_coordinate)};
    if (scene->bits) {
      scene->transform = chosen.transform == nullptr ? fitted(own.mesh) : checked_transform(chosen.transform);
      scene->origins = hitpipe::ref::origins_in_cube(scene->transform, most_coordinate);
      move_into_cube(own, scene->transform);
    }
    hitpipe::host::with_threads(threads, [&] {
      auto placed = on_its_grid(*scene, std::move(own.mesh));
      scene->tree = chosen.hierarchy != nullptr
                        ? checked_tree(*chosen.hierarchy, placed->mesh.triangles.size())
                        : built(*scene, *placed, threads);
      add_queries(*scene, *placed);
      scene->place(std::move(placed));
    });
    *out = new hitpipe_scene{std::move(scene)};
  });
}

void hitpipe_scene_close(hitpipe_scene* scene) {
  delete scene;
}

hitpipe_status hitpipe_scene_describe(const hitpipe_scene* scene, hitpipe_scene_info* out) {
  return guarded([&] {
    const SceneState& state = *given(scene, "scene").state;
    const Instanced* const instanced = state.instanced.get();
    const auto placed = state.placed();
    const hitpipe::ref::Closedness& closedness =
        instanced != nullptr ? instanced->closedness : placed->closedness();
    const hitpipe::ref::Normalisation& moved = state.transform;
    given(out, "out") = {
        .world = state.world.c_str(),
        .triangles = instanced != nullptr ? instanced->world.triangle_count() : placed->mesh.triangles.size(),
        .without_area = instanced != nullptr ? instanced->without_area : without_area(*placed),
        .closed = closedness.even() ? 1 : 0,
        .oriented = closedness.balanced() ? 1 : 0,
        .odd_edges = closedness.odd,
        .transform = {{moved.offset.x, moved.offset.y, moved.offset.z}, moved.scale}};
  });
}

hitpipe_status hitpipe_scene_move(hitpipe_scene* scene, const float* corners, int threads) {
  return guarded([&] {
    SceneState& state = *given(scene, "scene").state;
    if (state.instanced)
      throw Refusal(HITPIPE_BAD_ARGUMENT, "the scene has instances; hitpipe_scene_place() moves them");
    const auto before = state.placed();
    CheckedMesh own =
        with_corners(&given(corners, "corners"), before->mesh.vertices.size(), before->mesh.triangles);
    if (state.bits) move_into_cube(own, state.transform);
    hitpipe::host::with_threads(checked_threads(threads), [&] {
      auto placed = on_its_grid(state, std::move(own.mesh));
      add_queries(state, *placed);
      state.place(std::move(placed));
    });
  });
}
