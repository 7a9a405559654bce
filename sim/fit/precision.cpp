#include "sim/fit/precision.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "sim/fit/port_ranges.hpp"
#include "sw_ref/quantise/int_box.hpp"

namespace hitpipe::sim {

namespace {

/// The traversal whose box tests answer as the design does.
ref::TracerOptions tracer_like(const rtl::Design& design, hls::IntBits bits, const ref::CoarseAxes& coarse,
                               bool ends) {
  ref::TracerOptions options;
  options.algorithm = design.name.ends_with("plucker") ? ref::Algorithm::plu_dsa : ref::Algorithm::slabs_dsa;
  options.ends = ends;
  options.arithmetic = design.is_float() ? ref::Arithmetic::binary32 : ref::Arithmetic::integer;
  if (design.is_float()) return options;
  options.bits = bits;
  options.coarse = coarse;
  return options;
}

std::uint64_t box_tests(const ref::Tracer& tracer, const std::vector<ref::RecordedBatch>& batches,
                        int threads) {
  std::mutex counting;
  ref::TraceCounts sum;
  host::for_each_index(batches.size(), threads, [&](std::size_t i) {
    std::vector<std::uint32_t> triangles(batches[i].rays.size());
    ref::TraceCounts counts;
    tracer.trace({batches[i].rays, batches[i].query, triangles}, counts);
    const std::scoped_lock lock(counting);
    sum += counts;
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

/// Each format and its coarse axes are measured once.
class Measurements {
 public:
  explicit Measurements(const PrecisionSearch& search) : search_(search) {}

  double extra(hls::IntBits bits, const ref::CoarseAxes& coarse = {}, bool ends = true) {
    const auto [x, y, z] = coarse.dropped;
    const auto [at, is_new] = known_.try_emplace({bits.coord, bits.interval, x, y, z, ends ? 1 : 0}, 0.0);
    if (is_new) at->second = extra_box_tests_pct(search_, bits, coarse, ends);
    return at->second;
  }
  bool good(hls::IntBits bits, const ref::CoarseAxes& coarse = {}) {
    return extra(bits, coarse) <= search_.overhead_pct;
  }
  [[nodiscard]] int count() const { return static_cast<int>(known_.size()); }

 private:
  const PrecisionSearch& search_;
  std::map<std::array<int, 6>, double> known_;
};

bool fits(const ref::SceneDemands& scene, int coord_bits, const ref::CoarseAxes& coarse) {
  ref::IntOrigin lowest{};
  for (int axis = 0; axis < 3; ++axis)
    lowest[static_cast<std::size_t>(axis)] =
        static_cast<std::int32_t>(int_origin(scene, axis, coord_bits)->low);
  return ref::fits_grid(lowest, ref::quantise_box(scene.boxes, coord_bits), coarse, coord_bits);
}

/// Greedily: an axis that once cannot lose another bit is left as it is.
ref::CoarseAxes most_dropped(const PrecisionSearch& search, hls::IntBits bits, Measurements& measured) {
  ref::CoarseAxes coarse;
  std::vector<std::size_t> open{0, 1, 2};
  const auto next = [&](std::size_t axis) {
    ref::CoarseAxes coarser = coarse;
    ++coarser.dropped[axis];
    return coarser;
  };
  while (true) {
    std::erase_if(open, [&](std::size_t axis) {
      return !fits(*search.demands, bits.coord, next(axis)) || !measured.good(bits, next(axis));
    });
    if (open.empty()) return coarse;
    coarse = next(*std::min_element(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
      return measured.extra(bits, next(a)) < measured.extra(bits, next(b));
    }));
  }
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

std::string measured_text(double extra_box_tests_pct) {
  return fmt::format("{:.2f} % extra box tests, measured on the scene's rays", extra_box_tests_pct);
}

double extra_box_tests_pct(const PrecisionSearch& search, hls::IntBits bits, const ref::CoarseAxes& coarse,
                           bool ends) {
  const auto tracer =
      ref::make_tracer(search.scene->mesh, *search.bvh, tracer_like(*search.design, bits, coarse, ends));
  const auto reference = static_cast<double>(search.rays->reference.total().box_tests);
  const auto taken = static_cast<double>(box_tests(*tracer, search.rays->batches, search.threads));
  search.measured();
  return 100.0 * (taken / reference - 1.0);
}

std::optional<Precision> fewest_bits(const PrecisionSearch& search) {
  Measurements measured(search);
  Precision found;
  if (!search.design->is_float()) {
    const auto formats = formats_up_to(*search.design, search.most);
    if (!measured.good(search.most)) return std::nullopt;
    std::vector<int> coords;
    for (const auto& [n, intervals] : formats) coords.push_back(n);
    const int n = first_good(coords, [&](int each) {
      return measured.good({each, formats.at(each).back()});
    });
    const int t = first_good(formats.at(n), [&](int each) { return measured.good({n, each}); });
    found.bits = {n, t};
    found.extra_box_tests_pct = measured.extra(found.bits);
    found.coarse = most_dropped(search, found.bits, measured);
    found.coarse_extra_box_tests_pct = measured.extra(found.bits, found.coarse);
  }
  found.endless_extra_box_tests_pct = measured.extra(found.bits, found.coarse, false);
  found.ends = found.endless_extra_box_tests_pct > search.overhead_pct;
  found.formats_measured = measured.count();
  return found;
}

}  // namespace hitpipe::sim
