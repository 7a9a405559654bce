// Bounds of all rays of one kind and source, as intervals. They follow from the camera's image, the lights
// and the surfaces, and hold for any pixels of the image.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rays/mesh/aabb.hpp"
#include "rays/scene/scene.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::ref {

/// Where the rays of a family end, if not at a surface.
enum class RayEnd : std::uint8_t { none, light, reach };  ///< reach: of occlusion

/// Every ray of the family has its origin in one box and its computed direction in the other.
struct RayFamily {
  RayKind kind = RayKind::primary;
  Aabb origin;
  Aabb direction;
  std::string why;  ///< what the bounds follow from
  RayEnd end = RayEnd::none;

  [[nodiscard]] bool has_one_origin() const { return origin.min == origin.max; }
};

/// The image that the bounds cover: any of its pixels.
struct ViewOptions {
  int width = 256;  ///< only the ratio of the two matters
  int height = 256;
  WhittedOptions light{};
};

/// Primary rays first, then secondary ones, then those to each light and those of occlusion.
[[nodiscard]] std::vector<RayFamily> ray_families(const Scene& scene, const ViewOptions& view);

}  // namespace hitpipe::ref
