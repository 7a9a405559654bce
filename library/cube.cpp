// From a scene's own units into the cube.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "library/failure.hpp"
#include "library/shapes.hpp"
#include "library/transform.hpp"
#include "rays/scene/normalise.hpp"
#include "rays/world/to_cube.hpp"

namespace hitpipe::library {

namespace {

glm::dvec3 vector(const double* v) {
  return {v[0], v[1], v[2]};
}

void store(const glm::vec3& v, float* out) {
  for (int axis = 0; axis < 3; ++axis) *out++ = v[axis];
}

/// Throws a Refusal unless the bounds are finite and not inverted.
ref::BasicAabb<double> checked_bounds(const hitpipe_bounds& bounds, const char* what) {
  const ref::BasicAabb<double> own{vector(bounds.min), vector(bounds.max)};
  for (int axis = 0; axis < 3; ++axis) {
    const double low = own.min[axis];
    const double high = own.max[axis];
    if (!std::isfinite(low) || !std::isfinite(high) || low > high)
      throw Refusal(HITPIPE_BAD_BOX,
                    fmt::format("{}: {} from {} to {}; it must be finite and from low to high", what,
                                "xyz"[axis], low, high));
  }
  return own;
}

}  // namespace

}  // namespace hitpipe::library

using namespace hitpipe::library;  // NOLINT(google-build-using-namespace): what follows is this namespace's,
                                   // in C

hitpipe_status hitpipe_fit(const hitpipe_bounds* bounds, hitpipe_transform* out) {
  return guarded([&] {
    const auto own = checked_bounds(given(bounds, "bounds"), "bounds");
    const hitpipe::ref::Bounds box{own.min, own.max};
    const hitpipe::ref::Normalisation fitted = hitpipe::ref::fit_to_cube(box, {});
    if (!std::isnormal(fitted.scale))
      throw Refusal(
          HITPIPE_BAD_BOX,
          fmt::format("bounds: the longest side is {}; no scale takes that into the cube", box.longest()));
    given(out, "out") = {.offset = {fitted.offset.x, fitted.offset.y, fitted.offset.z},
                         .scale = fitted.scale};
  });
}

hitpipe_status hitpipe_to_cube_box(const hitpipe_transform* transform, const hitpipe_bounds* box,
                                   hitpipe_box* out) {
  return guarded([&] {
    const auto own = checked_bounds(given(box, "box"), "box");
    const hitpipe::ref::Aabb moved = hitpipe::ref::box_to_cube(own, checked_transform(transform));
    hitpipe_box rounded;
    store(moved.min, rounded.min);
    store(moved.max, rounded.max);
    static_cast<void>(checked({&rounded, 1}));
    given(out, "out") = rounded;
  });
}

hitpipe_status hitpipe_to_cube_ray(const hitpipe_transform* transform, const double origin[3],
                                   const double direction[3], double length, hitpipe_ray* out) {
  return guarded([&] {
    const hitpipe::ref::Ray moved =
        hitpipe::ref::ray_to_cube(vector(&given(origin, "origin")), vector(&given(direction, "direction")),
                                  length, checked_transform(transform));
    if (std::isfinite(length) && std::isinf(moved.length))
      throw Refusal(
          HITPIPE_BAD_RAY,
          fmt::format("ray: length = {} is beyond binary32; for a ray without an end pass INFINITY", length));
    hitpipe_ray rounded;
    store(moved.origin, rounded.origin);
    store(moved.direction, rounded.direction);
    rounded.length = moved.length;
    static_cast<void>(checked(rounded));
    given(out, "out") = rounded;
  });
}
