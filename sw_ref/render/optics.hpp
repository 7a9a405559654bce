// Mirrored and refracted rays. They bend about the shading normal, so that smooth meshes look smooth. If that
// would send them to the wrong side of the triangle, they bend about the triangle's own normal.
#pragma once

#include <optional>

#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {

/// The infinite ray that a mirror at `point` sends back for a ray of this direction. Its direction has length
/// 1, apart from rounding to binary32. Its origin lies on the side that the ray came from.
[[nodiscard]] Ray mirrored_ray(const SurfacePoint& point, const glm::vec3& direction);

/// The infinite ray that passes through the surface, by Snell's law. `index` is the refractive index of the
/// inside relative to the outside; the ray enters if point.front. Its origin lies behind the surface. Nothing
/// for total reflection.
[[nodiscard]] std::optional<Ray> refracted_ray(const SurfacePoint& point, const glm::vec3& direction,
                                               float index);

}  // namespace hitpipe::ref
