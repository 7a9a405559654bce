// The image of a scene by primary, shadow, mirrored and refracted rays (section 4.2), with counts of the
// work. Each tile of the image is traced in batches of similar rays, as in section 5.5: the primary rays; the
// shadow rays from the points that they hit, light by light; the mirrored and then the refracted rays; their
// shadow rays; and so on.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include <glm/vec3.hpp>

#include "host/piece.hpp"
#include "rays/scene/scene.hpp"
#include "rays/trace/tracer.hpp"
#include "sw_ref/render/whitted.hpp"

namespace hitpipe::ref {

struct RenderOptions {
  int width = 256;
  int height = 256;
  int threads = 1;
  int tile_side = 32;                  ///< in pixels; see tile_side_for()
  host::Piece tiles{};                 ///< only these tiles, which are in one order; the rest stays black
  bool picture = true;                 ///< fill image and triangles; false: only trace
  WhittedOptions light{};              ///< which rays follow
  const Surfaces* surfaces = nullptr;  ///< as Whitted has them
  bool maps = false;  ///< fill RenderResult::depth, box_tests, triangle_tests; needs `picture`
  /// Called from any thread with the finished share of the image, 0..1.
  std::function<void(double)> progress = [](double) {};
  /// If not empty, called from any thread with each batch of rays and its answers.
  std::function<void(RayKind, const TraceJob&)> traced = {};
};

/// The tile side for bundles of up to `bundle` rays, so that primary rays fill them: 8 for 64, 16 for 256,
/// otherwise 32.
[[nodiscard]] int tile_side_for(int bundle);

/// How many tiles a picture has.
[[nodiscard]] std::uint64_t tile_count(const RenderOptions& options);

/// Counts by kind of ray.
struct RenderCounts {
  TraceCounts primary;
  TraceCounts secondary;
  TraceCounts shadow;

  [[nodiscard]] TraceCounts& of(RayKind kind);
  [[nodiscard]] TraceCounts total() const;
  RenderCounts& operator+=(const RenderCounts& other);
  friend bool operator==(const RenderCounts&, const RenderCounts&) = default;
};

/// The work of the renderer apart from tracing.
struct ShadingCounts {
  std::uint64_t surface_points = 0;     ///< hits that were shaded
  std::uint64_t light_evaluations = 0;  ///< direct light computed for them
  /// The most bytes in any tile of rays that wait or are being traced, by RayKind.
  std::array<std::uint64_t, 3> queue_bytes{};

  [[nodiscard]] std::uint64_t queue_bytes_of(RayKind kind) const {
    return queue_bytes.at(static_cast<std::size_t>(kind));
  }
  /// Adds up the counts; for queues takes the larger.
  ShadingCounts& operator+=(const ShadingCounts& other);
  friend bool operator==(const ShadingCounts&, const ShadingCounts&) = default;
};

/// Pictures are stored row by row from the top.
struct RenderResult {
  int width = 0;
  int height = 0;
  std::vector<glm::vec3> image;          ///< linear
  std::vector<std::uint32_t> triangles;  ///< the triangle of each pixel, Hit::none for the sky
  std::vector<float> depth;              ///< depth_of() the triangle, infinite for the sky
  std::vector<float> box_tests;          ///< for all rays of the pixel
  std::vector<float> triangle_tests;
  RenderCounts counts;
  ShadingCounts shading;
};

/// By pixel: the box tests beyond the reference's, 0 if there are fewer. Both have maps of one scene and
/// size.
[[nodiscard]] std::vector<float> extra_box_tests(const RenderResult& result, const RenderResult& reference);

/// `tracer` must be made for `scene.mesh`; the camera must be in the cube. Throws std::invalid_argument for
/// sizes or threads below 1, and as Whitted does. The result does not depend on the number of threads. With
/// the exact triangle test, image, triangles, depth and numbers of rays do not depend on the tracer or the
/// tile side.
[[nodiscard]] RenderResult render(const Scene& scene, const Tracer& tracer, const RenderOptions& options);

}  // namespace hitpipe::ref
