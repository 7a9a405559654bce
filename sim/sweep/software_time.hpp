// How long a design's software traversal takes, as a ratio to that of fp_slabs: processor time of one thread
// for the same rays, the exact triangle test included.
#pragma once

#include <memory>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "sw_ref/experiment/recording.hpp"

namespace hitpipe::sim {

/// Three digits after the point: more is noise.
[[nodiscard]] double milli(double time);

/// Thread-safe.
class SoftwareTime {
 public:
  /// Rays of the scene's image at the size given, scaled down to at most `longest_side` pixels. Scene and
  /// hierarchy must outlive it.
  static constexpr int longest_side = 128;
  SoftwareTime(const ref::Scene& scene, const ref::Bvh& bvh, int width, int height);

  /// Both are timed now, one after the other, each by the fastest of three runs. 1 for fp_slabs. Throws as
  /// ref::make_tracer() does.
  [[nodiscard]] double ratio(const rtl::Design& design, const rtl::Format& format) const;

 private:
  [[nodiscard]] double seconds(const rtl::Design& design, const rtl::Format& format) const;

  const ref::Scene& scene_;
  const ref::Bvh& bvh_;
  std::vector<ref::RecordedBatch> batches_;
};

}  // namespace hitpipe::sim
