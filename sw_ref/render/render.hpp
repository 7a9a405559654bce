// The image of a scene by primary, shadow, mirrored and refracted rays (section 4.2), with counts of the
// work. Each tile of the image is traced in batches of like rays, as section 5.5 forms them: the primary
// rays; the shadow rays of what they hit, light by light; the mirrored, then the refracted rays; their shadow
// rays; and so on.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "sw_ref/render/whitted.hpp"
#include "sw_ref/scene/scene.hpp"
#include "sw_ref/traverse/tracer.hpp"

namespace hitpipe::ref {

struct RenderOptions {
  int width = 256;
  int height = 256;
  int threads = 1;
  int tile_side = 32;      ///< in pixels; see tile_side_for()
  WhittedOptions light{};  ///< how far secondary rays are followed
  bool maps = false;       ///< fill RenderResult::depth, box_tests, triangle_tests
  /// Told the finished share of the image, 0..1, from any thread.
  std::function<void(double)> progress = [](double) {};
  /// Shown each batch of rays with its answers, from any thread; empty: nobody looks.
  std::function<void(RayKind, const TraceJob&)> traced = {};
};

/// The side of tiles whose primary rays fill bundles of up to `bundle` rays: 8 for 64, 16 for 256, else 32.
[[nodiscard]] int tile_side_for(int bundle);

/// By kind of ray.
struct RenderCounts {
  TraceCounts primary;
  TraceCounts secondary;
  TraceCounts shadow;

  [[nodiscard]] TraceCounts& of(RayKind kind);
  [[nodiscard]] TraceCounts total() const;
  RenderCounts& operator+=(const RenderCounts& other);
  friend bool operator==(const RenderCounts&, const RenderCounts&) = default;
};

/// What the renderer did beside tracing.
struct ShadingCounts {
  std::uint64_t surface_points = 0;     ///< hits that were shaded
  std::uint64_t light_evaluations = 0;  ///< lights asked by them
  /// Of rays that wait or are being traced, at their most in a tile, by RayKind.
  std::array<std::uint64_t, 3> queue_bytes{};

  [[nodiscard]] std::uint64_t queue_bytes_of(RayKind kind) const {
    return queue_bytes.at(static_cast<std::size_t>(kind));
  }
  /// Queues: the larger of the two.
  ShadingCounts& operator+=(const ShadingCounts& other);
  friend bool operator==(const ShadingCounts&, const ShadingCounts&) = default;
};

/// Pictures row by row from the top.
struct RenderResult {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> image;          ///< linear
  std::vector<std::uint32_t> triangles;  ///< seen by each pixel, Hit::none for the sky
  std::vector<float> depth;              ///< distance from eye to triangle in the cube, infinite for the sky
  std::vector<float> box_tests;          ///< for all rays of the pixel
  std::vector<float> triangle_tests;
  RenderCounts counts;
  ShadingCounts shading;
};

/// `tracer` is made over `scene.mesh`, whose camera is in the cube. Throws std::invalid_argument for sizes or
/// threads below 1, and as Whitted does. The result does not depend on the number of threads; with the exact
/// triangle test neither image, triangles, depth nor numbers of rays depend on tracer and tile side.
[[nodiscard]] RenderResult render(const Scene& scene, const Tracer& tracer, const RenderOptions& options);

}  // namespace hitpipe::ref
