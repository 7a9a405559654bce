#include "sim/fit/precision.hpp"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace hitpipe::sim {

namespace {

ref::TracerOptions integer_tracer(const rtl::Design& design, hls::IntBits bits) {
  ref::TracerOptions options;
  options.algorithm = design.name == "int_plucker" ? ref::Algorithm::plu_dsa : ref::Algorithm::slabs_dsa;
  options.arithmetic = ref::Arithmetic::integer;
  options.bits = bits;
  return options;
}

std::uint64_t box_tests(const ref::Tracer& tracer, const std::vector<ref::RecordedBatch>& batches,
                        int threads) {
  std::mutex counting;
  ref::TraceCounts sum;
  tbb::task_arena arena(std::min(threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, batches.size(), [&](std::size_t i) {
      std::vector<std::uint32_t> triangles(batches[i].rays.size());
      ref::TraceCounts counts;
      tracer.trace({batches[i].rays, batches[i].query, triangles}, counts);
      const std::scoped_lock lock(counting);
      sum += counts;
    });
  });
  return sum.box_tests;
}

/// Formats by n, their t ascending, that the program has and that are no wider than `most`.
std::map<int, std::vector<int>> formats_up_to(const rtl::Design& design, hls::IntBits most) {
  std::map<int, std::vector<int>> formats;
  for (int n = hls::IntBits::min_coord; n <= most.coord; ++n) {
    for (int t = hls::IntBits::min_interval; t <= std::min(most.interval, hls::IntBits{n, 0}.product()); ++t)
      if (design.traced({n, t}) != nullptr) formats[n].push_back(t);
  }
  return formats;
}

/// The first of `sorted` that is good, when all after a good one are and the last is.
template <class Value, class Good>
Value first_good(const std::vector<Value>& sorted, Good&& good) {
  return *std::partition_point(sorted.begin(), sorted.end() - 1, [&](Value value) { return !good(value); });
}

}  // namespace

SceneRays scene_rays(const ref::Scene& scene, const ref::Bvh& bvh, const ref::RenderOptions& options) {
  SceneRays rays;
  const std::unique_ptr<ref::Tracer> tracer = ref::make_tracer(scene.mesh, bvh, {});
  std::mutex recording;
  ref::RenderOptions recorded = options;
  recorded.traced = [&](ref::RayKind kind, const ref::TraceJob& job) {
    const std::scoped_lock lock(recording);
    rays.batches.push_back(
        {kind, job.query, {job.rays.begin(), job.rays.end()}, {job.triangles.begin(), job.triangles.end()}});
  };
  rays.reference = ref::render(scene, *tracer, recorded).counts;
  return rays;
}

double extra_box_tests_pct(const PrecisionSearch& search, hls::IntBits bits) {
  const auto tracer = ref::make_tracer(search.scene->mesh, *search.bvh, integer_tracer(*search.design, bits));
  const auto reference = static_cast<double>(search.rays->reference.total().box_tests);
  const auto taken = static_cast<double>(box_tests(*tracer, search.rays->batches, search.threads));
  search.measured();
  return 100.0 * (taken / reference - 1.0);
}

std::optional<Precision> fewest_bits(const PrecisionSearch& search) {
  std::map<std::pair<int, int>, double> known;
  const auto extra = [&](int n, int t) {
    const auto [at, is_new] = known.try_emplace({n, t}, 0.0);
    if (is_new) at->second = extra_box_tests_pct(search, {n, t});
    return at->second;
  };
  const auto formats = formats_up_to(*search.design, search.most);
  const auto good = [&](int n, int t) { return extra(n, t) <= search.overhead_pct; };
  if (!good(search.most.coord, search.most.interval)) return std::nullopt;
  std::vector<int> coords;
  for (const auto& [n, intervals] : formats) coords.push_back(n);
  const int n = first_good(coords, [&](int each) { return good(each, formats.at(each).back()); });
  const int t = first_good(formats.at(n), [&](int each) { return good(n, each); });
  return Precision{{n, t}, extra(n, t), static_cast<int>(known.size())};
}

}  // namespace hitpipe::sim
