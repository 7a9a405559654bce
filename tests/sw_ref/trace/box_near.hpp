// Boxes on the grid whose edges and faces are near a ray.
#pragma once

#include <algorithm>
#include <cstdint>

#include "sw_ref/judge/adversary/random.hpp"
#include "sw_ref/quantise/grid.hpp"
#include "sw_ref/quantise/int_box.hpp"
#include "sw_ref/scene/ray.hpp"

namespace hitpipe::ref {

/// A box around a point of the ray, moved by up to a few of its sides.
inline IntBox box_near(const Ray& ray, int coord_bits, adversary::Random& random) {
  const auto limit = grid_limit(coord_bits);
  const float t = std::abs(random.signed_unit()) * 2.0F;
  const int side_bits = random.between(0, coord_bits - 2);
  IntBox box;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto axis = static_cast<int>(i);
    const double at = static_cast<double>(ray.origin[axis]) + t * static_cast<double>(ray.direction[axis]);
    const auto centre =
        static_cast<std::int64_t>(std::clamp(at, -1.0, 1.0) * static_cast<double>(grid_scale(coord_bits)));
    const auto reach = (std::uint64_t{1} << side_bits) + 1;
    const std::int64_t a = centre - static_cast<std::int64_t>(random.below(reach));
    const std::int64_t b = centre + static_cast<std::int64_t>(random.below(reach)) - (random.coin() ? 1 : 0);
    box.min[i] = static_cast<std::int32_t>(std::clamp(std::min(a, b), -limit, limit));
    box.max[i] = static_cast<std::int32_t>(std::clamp(std::max(a, b), -limit, limit));
  }
  return box;
}

}  // namespace hitpipe::ref
