// How long a design's own traversal takes in software: processor time of one thread, the exact triangle test included.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "sim/operands/ray_list.hpp"
#include "sw_ref/judge/interval.hpp"
#include "sw_ref/render/recording.hpp"

namespace hitpipe::sim {

/// Rounded to three digits after the point; more would be noise.
[[nodiscard]] double milli(double time);

/// The rays in their order, with exact answers. A batch has rays of one query.
[[nodiscard]] std::vector<ref::RecordedBatch> listed_batches(const ref::Scene& scene, const ref::Bvh& bvh,
                                                             std::span<const AskedRay> rays);

/// Thread-safe.
class SoftwareTime {
 public:
  /// Takes the rays of the scene's image at the given size, scaled down to at most `longest_side` pixels.
  /// Scene and hierarchy must outlive this object.
  static constexpr int longest_side = 128;
  SoftwareTime(const ref::Scene& scene, const ref::Bvh& bvh, int width, int height,
               const ref::WhittedOptions& light);
  /// Takes rays of the list, evenly spaced, as many as such an image has pixels at most.
  SoftwareTime(const ref::Scene& scene, const ref::Bvh& bvh, std::span<const AskedRay> rays);

  /// Seconds for a million rays, measured now. Nothing for a design without a tracer of its own: the generic one is no
  /// measure of it. Throws what ref::make_tracer() throws.
  [[nodiscard]] std::optional<ref::Middle> of(const rtl::Design& design, const Format& format) const;

 private:
  const ref::Scene& scene_;
  const ref::Bvh& bvh_;
  std::vector<ref::RecordedBatch> batches_;
};

}  // namespace hitpipe::sim
