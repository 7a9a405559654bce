// What a host of the traversal core needs of a scene: rays as integers, distances, the image in memory.
#include <cstring>
#include <span>
#include <string>

#include "library/failure.hpp"
#include "library/scene.hpp"
#include "library/shapes.hpp"
#include "rays/image/core_image.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::library {

namespace {

const hls::WorldBits& bits_of(const SceneState& scene) {
  if (!scene.bits)
    throw Refusal(HITPIPE_BAD_FORMAT,
                  "the scene is of the float world; a core's is of an integer one: \"20+1s20\"");
  return *scene.bits;
}

hitpipe_integer_ray c_ray(const ref::IntRay& ray) {
  hitpipe_integer_ray made{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    made.origin[axis] = ray.origin[axis];
    made.direction[axis] = ray.direction[axis];
    made.negative[axis] = ray.negative[axis] ? 1 : 0;
  }
  made.major = static_cast<std::uint8_t>(ray.major);
  made.length = ray.length;
  return made;
}

}  // namespace

}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_integer_rays(const hitpipe_scene* scene, const hitpipe_ray* rays, size_t ray_count,
                                    hitpipe_integer_ray* out) {
  return guarded([&] {
    const auto& bits = bits_of(*given(scene, "scene").state);
    const auto own = given(rays, ray_count);
    if (ray_count != 0) static_cast<void>(given(out, "out"));
    for (std::size_t i = 0; i < ray_count; ++i) static_cast<void>(ray_of_scene(*scene->state, own[i], i));
    for (std::size_t i = 0; i < ray_count; ++i) {
      hitpipe::host::look(i);
      out[i] = c_ray(hitpipe::ref::int_ray(in_world(*scene->state, own[i]), bits));
    }
  });
}

hitpipe_status hitpipe_own_distance(const hitpipe_scene* scene, const hitpipe_ray* ray, int64_t core_t,
                                    double* t) {
  return guarded([&] {
    const auto& bits = bits_of(*given(scene, "scene").state);
    const hitpipe::ref::Ray own = ray_of_scene(*scene->state, given(ray, "ray"), 0);
    given(t, "t") = own_t(*scene->state, hitpipe::ref::t_of_distance(core_t, own, bits));
  });
}

hitpipe_status hitpipe_core_image(const hitpipe_scene* scene, uint8_t* bytes, size_t capacity, size_t* size) {
  return guarded([&] {
    const auto& bits = bits_of(*given(scene, "scene").state);
    if (scene->state->instanced)
      throw Refusal(HITPIPE_BAD_ARGUMENT,
                    "the scene has instances; a core's image has none, so make one mesh of them");
    const auto placed = scene->state->placed();
    hitpipe::ref::Scene shell;
    shell.to_cube = scene->state->transform;
    const hitpipe::ref::CoreImage image = hitpipe::ref::core_image(
        {.bits = bits, .mesh = *placed->int_mesh, .scene = std::move(shell), .bvh = placed->bvh});
    const std::string text = hitpipe::ref::core_image_bytes(image.blocks);
    given(size, "size") = text.size();
    if (bytes != nullptr && capacity >= text.size()) std::memcpy(bytes, text.data(), text.size());
  });
}
