// The recorded rays of one image, so that many tracers can be measured on the same work without shading.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "sw_ref/judge/interval.hpp"
#include "sw_ref/render/render.hpp"

namespace hitpipe::ref {

/// Rays that were traced together: they have one tile, kind and light.
struct RecordedBatch {
  RayKind kind;
  Query query;
  std::vector<Ray> rays;
  std::vector<std::uint32_t> triangles;  ///< what the tracer answered
};

struct Recording {
  std::vector<RecordedBatch> batches;  ///< tile by tile with one thread, otherwise in any order
  RenderCounts counts;                 ///< what the tracer did for them
};

/// Every batch of an image, with the tracer's answers. It sets `options.traced` itself.
[[nodiscard]] Recording record_rays(const Scene& scene, const Tracer& tracer, RenderOptions options);

/// Every batch of an image, tile by tile. The batches depend only on the tile side (see tile_side_for()).
[[nodiscard]] std::vector<RecordedBatch> record_rays(const Scene& scene, const Bvh& bvh, int width,
                                                     int height, int bundle,
                                                     const WhittedOptions& light = {});

/// The work and time of a tracer for a recording.
struct Measurement {
  RenderCounts counts;
  std::vector<TraceCounts> of_batches;  ///< the counts of each batch
  std::vector<double> seconds;          ///< processor time of each run, on one thread
  std::uint64_t different = 0;          ///< rays whose answer differs from the recorded one
};

/// Traces all batches `repeats` times, >= 1, on one thread.
[[nodiscard]] Measurement measure(const Tracer& tracer, const std::vector<RecordedBatch>& batches,
                                  int repeats);

/// One of the counts.
using Count = std::uint64_t TraceCounts::*;

/// A count of one tracer over the same count of another, for the rays of a kind. The tiles of the image are
/// the groups.
[[nodiscard]] GroupedRatio ratio_by_tile(const std::vector<RecordedBatch>& batches, RayKind kind, Count count,
                                         const Measurement& above, const Measurement& below);

/// 95 % of 100 (ratio - 1), an increase in percent. Nothing from less than two tiles.
[[nodiscard]] std::optional<Interval> increase_interval(const GroupedRatio& ratio);

}  // namespace hitpipe::ref
