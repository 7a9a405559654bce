// Mirrored and refracted rays. They bend about the shading normal, so that smooth meshes look smooth, and
// about the triangle's own normal where the former would send them to the wrong side of the triangle.
#pragma once

#include <optional>

#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {

/// The infinite ray that a mirror at `point` sends back where a ray of this direction arrives. Its direction
/// has length 1 but for its rounding to binary32; its origin lies on the side that the ray came from.
[[nodiscard]] Ray mirrored_ray(const SurfacePoint& point, const glm::vec3& direction);

/// The infinite ray that passes the surface, by Snell's law: `index` is that of the inside relative to the
/// outside, and the ray enters where point.front. Its origin lies behind the surface. Nothing in the case of
/// total reflection.
[[nodiscard]] std::optional<Ray> refracted_ray(const SurfacePoint& point, const glm::vec3& direction,
                                               float index);

}  // namespace hitpipe::ref
