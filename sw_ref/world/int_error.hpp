// What the integer world changes: which rays find another triangle than in the float world, how far corners
// move, which pixels differ, and what box tests with few bits cost there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "hls/box/major_format.hpp"
#include "hls/world/world_format.hpp"
#include "rays/scene/scene.hpp"
#include "rays/trace/tracer.hpp"
#include "rays/tree/load_bvh.hpp"
#include "sw_ref/judge/interval.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::ref {

struct IntErrorOptions {
  hls::WorldBits world{};
  std::vector<hls::MajorBits> boxes{};  ///< box formats to count with
  int width = 128;
  int height = 128;
  WhittedOptions light{};
  HierarchyOptions hierarchy{};  ///< of both worlds
};

struct IntError {
  std::uint64_t rays = 0;            ///< of the float picture, of all kinds
  std::uint64_t different_rays = 0;  ///< another closest triangle, or another answer of a shadow ray
  std::uint64_t lost_hits = 0;       ///< of these: a triangle in the float world, none in the integer world
  std::uint32_t triangles = 0;
  std::uint32_t lost_to_rounding = 0;  ///< triangles of the float world that lose their area on the grid
  double largest_movement = 0;         ///< of a corner, in units of the [-1, 1] cube
  std::uint64_t pixels = 0;
  std::uint64_t different_pixels = 0;       ///< some channel differs by more than 1/256
  std::vector<std::uint32_t> different_at;  ///< their places, row by row
  double largest_difference = 0;            ///< of a channel
  TraceCounts exact;                        ///< the same rays in the integer world, with exact boxes
  std::vector<TraceCounts> with;            ///< with the boxes of each format

  [[nodiscard]] Share different() const { return {different_rays, rays}; }
};

/// The largest difference of a channel at which two pixels count as the same.
inline constexpr float same_colour = 1.0F / 256;

/// Both worlds trace the rays of the float picture, whose rays leave surfaces as far as int_offset() says.
/// Throws as make_hierarchy(), int_scene() and int_tracer().
[[nodiscard]] IntError int_error(const Scene& scene, const IntErrorOptions& options);

}  // namespace hitpipe::ref
