#include "sim/sweep/software_time.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "sim/cosim/generic_tracer.hpp"

namespace hitpipe::sim {

namespace {

std::vector<ref::RecordedBatch> record(const ref::Scene& scene, const ref::Bvh& bvh, int width, int height,
                                       const ref::WhittedOptions& light) {
  const int longest = std::max({width, height, SoftwareTime::longest_side});
  const auto scaled = [&](int side) { return std::max(1, side * SoftwareTime::longest_side / longest); };
  return ref::record_rays(scene, bvh, scaled(width), scaled(height), 1, light);
}

/// Evenly spaced.
std::vector<AskedRay> some_of(std::span<const AskedRay> rays) {
  constexpr std::size_t most = std::size_t{SoftwareTime::longest_side} * SoftwareTime::longest_side;
  const std::size_t step = (rays.size() + most - 1) / most;
  std::vector<AskedRay> some;
  for (std::size_t i = 0; i < rays.size(); i += step) some.push_back(rays[i]);
  return some;
}

}  // namespace

double milli(double time) {
  return std::round(1e3 * time) / 1e3;
}

std::vector<ref::RecordedBatch> listed_batches(const ref::Scene& scene, const ref::Bvh& bvh,
                                               std::span<const AskedRay> rays) {
  std::vector<ref::RecordedBatch> batches;
  for (const AskedRay& asked : rays) {
    const ref::Ray& ray = asked.ray;
    const ref::Query query = asked.query;
    if (batches.empty() || batches.back().query != query) {
      const bool any = query == ref::Query::any;
      batches.push_back({any ? ref::RayKind::shadow : ref::RayKind::primary, query, {}, {}});
    }
    batches.back().rays.push_back(ray);
  }
  const std::unique_ptr<ref::Tracer> tracer = ref::make_tracer(scene.mesh, bvh, {});
  for (ref::RecordedBatch& batch : batches) {
    batch.triangles.resize(batch.rays.size());
    ref::TraceCounts counts;
    tracer->trace({batch.rays, batch.query, batch.triangles}, counts);
  }
  return batches;
}

SoftwareTime::SoftwareTime(const ref::Scene& scene, const ref::Bvh& bvh, int width, int height,
                           const ref::WhittedOptions& light)
    : scene_(scene), bvh_(bvh), batches_(record(scene, bvh, width, height, light)) {}

SoftwareTime::SoftwareTime(const ref::Scene& scene, const ref::Bvh& bvh, std::span<const AskedRay> rays)
    : scene_(scene), bvh_(bvh), batches_(listed_batches(scene, bvh, some_of(rays))) {}

std::optional<ref::Middle> SoftwareTime::of(const rtl::Design& design, const Format& format) const {
  if (software_of(design).tracer == nullptr) return std::nullopt;
  const std::unique_ptr<ref::Tracer> tracer = make_tracer(design, {format}, scene_.mesh, bvh_);
  std::size_t rays = 0;
  for (const ref::RecordedBatch& batch : batches_) rays += batch.rays.size();
  if (rays == 0) return std::nullopt;
  std::vector<double> runs(9);  // six are needed for an interval
  for (double& run : runs)
    run = milli(1e6 * ref::measure(*tracer, batches_, 1).seconds.front() / static_cast<double>(rays));
  return ref::middle_of(std::move(runs));
}

}  // namespace hitpipe::sim
