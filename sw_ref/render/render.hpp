// The image of a scene by primary and shadow rays (section 4.2), with counts of the work.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/scene/scene.hpp"

namespace hitpipe::ref {

enum class BoxTestKind : std::uint8_t {
  float_slabs,  ///< as the thesis computes it; may miss a box that a ray only grazes
  robust,       ///< never misses a box: every ray finds its exact closest triangle
};

struct RenderCounts {
  std::uint64_t rays_primary = 0;
  std::uint64_t rays_shadow = 0;
  std::uint64_t box_tests = 0;
  std::uint64_t triangle_tests = 0;

  friend bool operator==(const RenderCounts&, const RenderCounts&) = default;
};

struct RenderResult {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> image;          ///< linear, row by row from the top
  std::vector<std::uint32_t> triangles;  ///< seen by each pixel, Hit::none for the sky
  RenderCounts counts;
};

/// `bvh` is built over `scene.mesh`. width, height >= 1 and threads >= 1, else std::invalid_argument. The
/// result does not depend on the number of threads.
[[nodiscard]] RenderResult render(const Scene& scene, const Bvh& bvh, int width, int height, int threads,
                                  BoxTestKind box_test);

}  // namespace hitpipe::ref
