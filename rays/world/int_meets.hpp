// The exact box test of the integer world (docs/integer_world.md).
#pragma once

#include <cstdint>

#include "hls/world/world_format.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::ref {

/// Does the ray meet the closed box at some T up to `length`? Exact.
[[nodiscard]] bool int_meets(const IntRay& ray, const IntBox& box, std::int64_t length,
                             const hls::WorldBits& bits);

}  // namespace hitpipe::ref
