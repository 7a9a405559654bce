// The rays of a picture, or of a list, as a core gets them, with what software answers and reads for them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

#include "rays/world/int_scene.hpp"
#include "sim/core/core_bench.hpp"
#include "sim/operands/ray_list.hpp"
#include "sw_ref/core/core_tracer.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::sim {

struct PictureRays {
  explicit PictureRays(std::shared_ptr<const ref::IntScene> scene) : scene_(std::move(scene)) {}

  std::vector<CoreJob> jobs;
  std::vector<std::uint32_t> triangles;  ///< by job: the number of what it hits, or IntHit::none
  ref::TraceCounts work;
  std::uint64_t restarts = 0;

  /// How many answers are not software's: the triangle and T, or for any hit whether there is one; or failed, or
  /// with weights that are not those of its triangle.
  [[nodiscard]] std::uint64_t wrong(std::span<const CoreAnswer> answers) const;
  /// The picture that right answers make, of the options with which the rays were recorded; linear.
  [[nodiscard]] std::vector<glm::vec3> drawn(std::span<const CoreAnswer> answers,
                                             ref::RenderOptions render) const;
  [[nodiscard]] const ref::IntScene& scene() const { return *scene_; }

 private:
  std::shared_ptr<const ref::IntScene> scene_;  ///< whose triangles the answers name
};

/// Renders the picture, or some of its tiles, with one thread, so the rays are in one order. `image` is of
/// `scene`. Throws as render() and CoreTracer do.
[[nodiscard]] PictureRays picture_rays(const std::shared_ptr<const ref::IntScene>& scene,
                                       const ref::CoreImage& image, const ref::CoreTracerOptions& options,
                                       ref::RenderOptions render);

/// The same of a list, in its order.
[[nodiscard]] PictureRays listed_rays(const std::shared_ptr<const ref::IntScene>& scene,
                                      const ref::CoreImage& image, const ref::CoreTracerOptions& options,
                                      std::span<const AskedRay> rays);

}  // namespace hitpipe::sim
