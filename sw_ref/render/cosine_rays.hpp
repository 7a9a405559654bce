// Rays that leave a surface at random, as often in a direction as matt surfaces scatter light there: by the
// cosine of the angle to the normal.
#pragma once

#include <cstdint>

#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {

/// A direction of length 1, apart from rounding to binary32, about the shading normal. One that would pass
/// the triangle is mirrored by its plane. `key` decides it; all other bits of the result follow from sums,
/// products, quotients and roots of doubles, so it is the same on every machine.
[[nodiscard]] glm::vec3 cosine_direction(const SurfacePoint& point, std::uint64_t key);

/// The ray in that direction from beside the surface. `length` > 0, or infinite.
[[nodiscard]] Ray cosine_ray(const SurfacePoint& point, std::uint64_t key, float length);

}  // namespace hitpipe::ref
