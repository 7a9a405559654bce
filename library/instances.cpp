// Scenes of meshes and instances of the C interface: opened, placed, asked what a triangle is.
#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "host/format.hpp"
#include "host/parallel.hpp"
#include "library/failure.hpp"
#include "library/mesh.hpp"
#include "library/scene.hpp"
#include "library/shapes.hpp"
#include "library/transform.hpp"
#include "rays/scene/triangle_numbers.hpp"
#include "rays/world/to_cube.hpp"

namespace hitpipe::library {

namespace {

/// That a thread puts on the grid at a time.
constexpr std::size_t instances_at_once = 1024;

struct OwnScene {
  std::vector<ref::SourceMesh> meshes;
  std::vector<ref::OwnInstance> instances;
  std::vector<std::uint32_t> numbers;
};

ref::SourceMesh in_doubles(const ref::Mesh& mesh) {
  ref::SourceMesh made;
  made.vertices.assign(mesh.vertices.begin(), mesh.vertices.end());
  made.triangles = mesh.triangles;
  return made;
}

void set_matrix(ref::OwnInstance& instance, const double* matrix, std::size_t i) {
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < 4; ++column) {
      const double x = matrix[4 * row + column];
      if (!std::isfinite(x))
        throw Refusal(
            HITPIPE_BAD_INSTANCE,
            fmt::format("instance {}: matrix[{}] = {}; numbers must be finite", i, 4 * row + column, x));
      if (column < 3) {
        instance.linear[column][row] = x;
      } else {
        instance.move[row] = x;
      }
    }
  }
}

OwnScene checked(const hitpipe_mesh* meshes, std::size_t mesh_count, const hitpipe_instance* instances,
                 std::size_t instance_count) {
  OwnScene own;
  if (mesh_count != 0) static_cast<void>(given(meshes, "meshes"));
  if (instance_count != 0) static_cast<void>(given(instances, "instances"));
  for (std::size_t i = 0; i < mesh_count; ++i) {
    try {
      own.meshes.push_back(in_doubles(checked_mesh(meshes[i]).mesh));
    } catch (const Refusal& why) {
      throw Refusal(why.status(), fmt::format("mesh {}: {}", i, why.what()));
    }
    if (own.meshes.back().triangles.empty())
      throw Refusal(HITPIPE_BAD_MESH,
                    fmt::format("mesh {}: it has no triangle; a mesh of instances has one", i));
  }
  for (std::size_t i = 0; i < instance_count; ++i) {
    const hitpipe_instance& instance = instances[i];
    if (instance.mesh >= mesh_count)
      throw Refusal(HITPIPE_BAD_INSTANCE,
                    fmt::format("instance {}: mesh {}; there are {}", i, instance.mesh, mesh_count));
    ref::OwnInstance& made = own.instances.emplace_back();
    made.mesh = instance.mesh;
    made.mask = instance.mask;
    set_matrix(made, instance.matrix, i);
    own.numbers.push_back(instance.number);
  }
  return own;
}

ref::Normalisation fitted(const OwnScene& own, std::span<const glm::dvec3> points) {
  std::optional<ref::Bounds> bounds = ref::own_bounds(own.meshes, own.instances);
  for (const glm::dvec3& point : points) {
    if (!bounds) bounds = ref::Bounds{point, point};
    bounds->grow(point);
  }
  if (!bounds) return {};
  if (!(bounds->longest() > 0))
    throw Refusal(HITPIPE_BAD_MESH,
                  "all corners are in one place; an integer world needs a scene with some extent");
  return ref::fit_to_cube(*bounds, {});
}

/// Calls what makes or moves instances. What it refuses is an instance.
template <class Call>
void refusing(const Call& call) {
  try {
    call();
  } catch (const std::runtime_error& why) {
    throw Refusal(HITPIPE_BAD_INSTANCE, why.what());
  } catch (const std::logic_error& why) {
    throw Refusal(HITPIPE_BAD_INSTANCE, why.what());
  }
}

ref::BuildOptions leaves(int threads) {
  ref::BuildOptions options = ref::surface_area_build;
  options.threads = threads;
  return options;
}

Instanced& instanced(const hitpipe_scene* scene) {
  Instanced* const its = given(scene, "scene").state->instanced.get();
  if (its == nullptr)
    throw Refusal(HITPIPE_BAD_ARGUMENT, "the scene has no instances; hitpipe_scene_move() moves its corners");
  return *its;
}

}  // namespace

Instanced::Instanced(std::span<const ref::SourceMesh> meshes, std::span<const ref::OwnInstance> instances,
                     std::vector<std::uint32_t> its_numbers, const ref::Normalisation& transform,
                     const hls::WorldBits& bits, int threads)
    : numbers(std::move(its_numbers)),
      grids(meshes, instances, transform, bits),
      world(ref::int_instances(meshes, instances, grids, bits, leaves(threads))),
      triangles(std::make_shared<ref::FastInstances>(world, ref::VectorWidth::best)) {
  // Whatever is rounded, it stays so by the ends of edges, as equal corners stay equal.
  std::vector<ref::Closedness> closed;
  std::vector<std::size_t> flat;
  for (const ref::IntObject& mesh : world.meshes()) {
    closed.push_back(ref::closedness(mesh.triangles()));
    flat.push_back(
        static_cast<std::size_t>(std::count_if(mesh.triangles().begin(), mesh.triangles().end(),
                                               [](const auto& t) { return ref::is_degenerate(t); })));
  }
  for (const ref::OwnInstance& instance : instances) {
    const ref::Closedness& of_mesh = closed[instance.mesh];
    closedness.edges += of_mesh.edges;
    closedness.odd += of_mesh.odd;
    closedness.open += of_mesh.odd;
    closedness.open_turned += of_mesh.turned;
    without_area += flat[instance.mesh];
  }
}

}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_scene_open_instances(const hitpipe_mesh* meshes, size_t mesh_count,
                                            const hitpipe_instance* instances, size_t instance_count,
                                            const hitpipe_scene_options* options, hitpipe_scene** out) {
  return guarded([&] {
    static_cast<void>(given(out, "out"));
    const hitpipe_scene_options chosen = options == nullptr ? hitpipe_scene_options{} : *options;
    auto state = std::make_shared<SceneState>();
    state->bits = chosen_world(chosen.world);
    if (!state->bits)
      throw Refusal(
          HITPIPE_BAD_FORMAT,
          "instances are of an integer world, \"20+1s20\": in the float world the corners that they "
          "have in the world would be rounded ones that no one has given");
    if (chosen.hierarchy != nullptr)
      throw Refusal(HITPIPE_BAD_ARGUMENT, "hierarchy: a scene of instances builds its own");
    const int threads = checked_threads(chosen.threads);
    OwnScene own = checked(meshes, mesh_count, instances, instance_count);
    state->world = hitpipe::to_string(hitpipe::Format(*state->bits));
    state->transform = chosen.transform == nullptr ? fitted(own, {}) : checked_transform(chosen.transform);
    state->origins = hitpipe::ref::origins_in_cube(state->transform, most_coordinate);
    hitpipe::host::with_threads(threads, [&] {
      refusing([&] {
        state->instanced = std::make_unique<Instanced>(own.meshes, own.instances, std::move(own.numbers),
                                                       state->transform, *state->bits, threads);
      });
      auto placed = std::make_shared<Placed>();
      placed->queries = hitpipe::ref::int_queries(state->instanced->triangles, *state->bits);
      state->place(std::move(placed));
    });
    *out = new hitpipe_scene{std::move(state)};
  });
}

hitpipe_status hitpipe_fit_instances(const hitpipe_mesh* meshes, size_t mesh_count,
                                     const hitpipe_instance* instances, size_t instance_count,
                                     const float* points, size_t point_count, hitpipe_transform* out) {
  return guarded([&] {
    const OwnScene own = checked(meshes, mesh_count, instances, instance_count);
    given(out, "out") = c_transform(fitted(own, checked_points(points, point_count)));
  });
}

hitpipe_status hitpipe_scene_place(hitpipe_scene* scene, size_t first, const double* matrices, size_t count,
                                   int threads) {
  return guarded([&] {
    Instanced& its = instanced(scene);
    const std::size_t all = its.numbers.size();
    if (first > all || count > all - first)
      throw Refusal(HITPIPE_BAD_ARGUMENT,
                    fmt::format("instances {} to {}; the scene has {}", first, first + count, all));
    if (count == 0) return;
    static_cast<void>(given(matrices, "matrices"));
    hitpipe::host::with_threads(checked_threads(threads), [&] {
      std::vector<hitpipe::ref::GridMap> maps(count);
      hitpipe::host::for_each_block(0, count, instances_at_once, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
          hitpipe::ref::OwnInstance moved{.mesh = its.world.instances()[first + i].mesh};
          set_matrix(moved, matrices + 12 * i, first + i);
          try {
            maps[i] = its.grids.map(moved);
          } catch (const std::out_of_range& why) {
            throw Refusal(HITPIPE_BAD_INSTANCE, fmt::format("instance {}: {}", first + i, why.what()));
          }
        }
      });
      const std::unique_lock alone(scene->state->instances_stay);
      std::vector<std::uint32_t> entries;
      refusing([&] { its.world.place(static_cast<std::uint32_t>(first), std::move(maps), entries); });
      its.triangles->follow(static_cast<std::uint32_t>(first), count, entries);
    });
  });
}

hitpipe_status hitpipe_scene_masked(const hitpipe_scene* scene, uint8_t mask, hitpipe_scene** out) {
  return guarded([&] {
    static_cast<void>(instanced(scene));
    given(out, "out") = new hitpipe_scene{scene->state, mask};
  });
}

hitpipe_status hitpipe_parts(const hitpipe_scene* scene, const uint32_t* triangles, size_t count,
                             hitpipe_part* out) {
  return guarded([&] {
    const SceneState& state = *given(scene, "scene").state;
    if (count == 0) return;
    const uint32_t* const numbers = &given(triangles, "triangles");
    hitpipe_part* const parts = &given(out, "out");
    const std::size_t all =
        state.instanced ? state.instanced->world.triangle_count() : state.placed()->mesh.triangles.size();
    for (std::size_t i = 0; i < count; ++i)
      if (numbers[i] >= all && numbers[i] != HITPIPE_NO_TRIANGLE)
        throw Refusal(HITPIPE_BAD_ARGUMENT,
                      fmt::format("triangle {} is {}; the scene has {}", i, numbers[i], all));
    for (std::size_t i = 0; i < count; ++i) {
      constexpr uint32_t none = HITPIPE_NO_TRIANGLE;
      if (numbers[i] == none) {
        parts[i] = {none, none, none, none};
      } else if (!state.instanced) {
        parts[i] = {0, 0, 0, numbers[i]};
      } else {
        const auto [instance, triangle] = state.instanced->world.part(numbers[i]);
        parts[i] = {instance, state.instanced->numbers[instance],
                    state.instanced->world.instances()[instance].mesh, triangle};
      }
    }
  });
}
