#include "sw_ref/render/recording.hpp"

#include <memory>
#include <mutex>
#include <utility>

#include "host/parallel.hpp"
#include "rays/exact/exact_triangle.hpp"

namespace hitpipe::ref {
namespace {

bool same(Query query, std::uint32_t a, std::uint32_t b) {
  return query == Query::any ? (a == Hit::none) == (b == Hit::none) : a == b;
}

}  // namespace

Recording record_rays(const Scene& scene, const Tracer& tracer, RenderOptions options) {
  Recording recording;
  std::mutex one_at_a_time;
  options.traced = [&](RayKind kind, const TraceJob& job) {
    const std::scoped_lock lock(one_at_a_time);
    recording.batches.push_back(
        {kind, job.query, {job.rays.begin(), job.rays.end()}, {job.triangles.begin(), job.triangles.end()}});
  };
  recording.counts = render(scene, tracer, options).counts;
  return recording;
}

std::vector<RecordedBatch> record_rays(const Scene& scene, const Bvh& bvh, int width, int height, int bundle,
                                       const WhittedOptions& light) {
  const std::unique_ptr<Tracer> tracer = make_tracer(scene.mesh, bvh, {});
  return record_rays(scene, *tracer,
                     {.width = width, .height = height, .tile_side = tile_side_for(bundle), .light = light})
      .batches;
}

Measurement measure(const Tracer& tracer, const std::vector<RecordedBatch>& batches, int repeats) {
  Measurement result;
  std::vector<std::vector<std::uint32_t>> triangles(batches.size());
  for (std::size_t i = 0; i < batches.size(); ++i) triangles[i].resize(batches[i].rays.size());
  for (int run = 0; run < repeats; ++run) {
    std::vector<TraceCounts> counts(batches.size());
    const double start = host::thread_seconds();
    for (std::size_t i = 0; i < batches.size(); ++i)
      tracer.trace({batches[i].rays, batches[i].query, triangles[i]}, counts[i]);
    result.seconds.push_back(host::thread_seconds() - start);
    result.of_batches = std::move(counts);
  }
  for (std::size_t i = 0; i < batches.size(); ++i) result.counts.of(batches[i].kind) += result.of_batches[i];
  for (std::size_t i = 0; i < batches.size(); ++i)
    for (std::size_t ray = 0; ray < batches[i].rays.size(); ++ray)
      result.different += same(batches[i].query, triangles[i][ray], batches[i].triangles[ray]) ? 0 : 1;
  return result;
}

GroupedRatio ratio_by_tile(const std::vector<RecordedBatch>& batches, RayKind kind, Count count,
                           const Measurement& above, const Measurement& below) {
  GroupedRatio ratio;
  double tile_above = 0;
  double tile_below = 0;
  for (std::size_t i = 0; i < batches.size(); ++i) {
    // The batches of a tile begin with its primary rays.
    if (batches[i].kind == RayKind::primary) {
      ratio.add(tile_above, tile_below);
      tile_above = tile_below = 0;
    }
    if (batches[i].kind != kind) continue;
    tile_above += static_cast<double>(above.of_batches[i].*count);
    tile_below += static_cast<double>(below.of_batches[i].*count);
  }
  ratio.add(tile_above, tile_below);
  return ratio;
}

std::optional<Interval> increase_interval(const GroupedRatio& ratio) {
  if (ratio.groups() < 2) return std::nullopt;
  const Interval of = ratio.interval();
  return Interval{100.0 * (of.low - 1.0), 100.0 * (of.high - 1.0)};
}

}  // namespace hitpipe::ref
