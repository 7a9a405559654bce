// Rays of one kind and source, bounded: what a camera's frustum, a light and the surfaces say of all of them,
// by intervals, whichever pixels are asked for.
#pragma once

#include <string>
#include <vector>

#include "sw_ref/geometry/aabb.hpp"
#include "sw_ref/render/whitted.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

/// Every ray of the family has its origin in one box and its direction, as computed, in the other.
struct RayFamily {
  RayKind kind = RayKind::primary;
  Aabb origin;
  Aabb direction;
  std::string why;  ///< the evidence

  [[nodiscard]] bool has_one_origin() const { return origin.min == origin.max; }
};

/// What bounds the image: any of its pixels lies within.
struct ViewOptions {
  int width = 256;  ///< only the ratio of the two matters
  int height = 256;
  int bounces = WhittedOptions{}.bounces;
};

/// Primary rays first, then secondary ones, then those to each light.
[[nodiscard]] std::vector<RayFamily> ray_families(const Scene& scene, const ViewOptions& view);

}  // namespace hitpipe::ref
