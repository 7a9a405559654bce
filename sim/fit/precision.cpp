#include "sim/fit/precision.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "sim/software.hpp"

namespace hitpipe::sim {

namespace {

/// The software traversal whose box tests answer as the design does.
ref::TracerOptions tracer_like(const rtl::Design& design, const rtl::Format& format,
                               const ref::CoarseAxes& coarse, bool ends) {
  const Software& software = software_of(design);
  if (software.traversal == nullptr) throw std::runtime_error(missing(design, traversal_part));
  ref::TracerOptions options = software.traversal(format);
  options.ends = options.ends && ends;
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

/// The first good one of `sorted`. If one is good, all after it are good; the last one is.
template <class Value, class Good>
const Value& first_good(const std::vector<Value>& sorted, Good&& good) {
  return *std::partition_point(sorted.begin(), sorted.end() - 1,
                               [&](const Value& value) { return !good(value); });
}

/// Measures each format with its coarse axes once.
class Measurements {
 public:
  explicit Measurements(const PrecisionSearch& search) : search_(search) {}

  double extra(const rtl::Format& format, const ref::CoarseAxes& coarse = {}, bool ends = true) {
    const auto [at, is_new] = known_.try_emplace({format.numbers(), coarse.dropped, ends}, 0.0);
    if (is_new) at->second = extra_box_tests_pct(search_, format, coarse, ends);
    return at->second;
  }
  bool good(const rtl::Format& format, const ref::CoarseAxes& coarse = {}) {
    return extra(format, coarse) <= search_.overhead_pct;
  }
  [[nodiscard]] int count() const { return static_cast<int>(known_.size()); }

 private:
  const PrecisionSearch& search_;
  std::map<std::tuple<rtl::FormatNumbers, std::array<int, 3>, bool>, double> known_;
};

/// Greedy: an axis that cannot lose another bit is not tried again.
ref::CoarseAxes most_dropped(const PrecisionSearch& search, const rtl::Format& format,
                             Measurements& measured) {
  const auto fits = software_of(*search.design).fits_coarse;
  if (fits == nullptr) return {};
  ref::CoarseAxes coarse;
  std::vector<std::size_t> open{0, 1, 2};
  const auto next = [&](std::size_t axis) {
    ref::CoarseAxes coarser = coarse;
    ++coarser.dropped[axis];
    return coarser;
  };
  while (true) {
    std::erase_if(open, [&](std::size_t axis) {
      return !fits(format, *search.demands, next(axis)) || !measured.good(format, next(axis));
    });
    if (open.empty()) return coarse;
    coarse = next(*std::min_element(open.begin(), open.end(), [&](std::size_t a, std::size_t b) {
      return measured.extra(format, next(a)) < measured.extra(format, next(b));
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

double extra_box_tests_pct(const PrecisionSearch& search, const rtl::Format& format,
                           const ref::CoarseAxes& coarse, bool ends) {
  const auto tracer =
      ref::make_tracer(search.scene->mesh, *search.bvh, tracer_like(*search.design, format, coarse, ends));
  const auto reference = static_cast<double>(search.rays->reference.total().box_tests);
  const auto taken = static_cast<double>(box_tests(*tracer, search.rays->batches, search.threads));
  search.measured();
  return 100.0 * (taken / reference - 1.0);
}

std::optional<Precision> fewest_bits(const PrecisionSearch& search) {
  Measurements measured(search);
  Precision found{.format = search.most};
  if (const auto up_to = software_of(*search.design).up_to; up_to != nullptr) {
    if (!measured.good(search.most)) return std::nullopt;
    const std::vector<std::vector<rtl::Format>> groups = up_to(search.most);
    const auto& group = first_good(groups, [&](const auto& each) { return measured.good(each.back()); });
    found.format = first_good(group, [&](const rtl::Format& each) { return measured.good(each); });
    found.extra_box_tests_pct = measured.extra(found.format);
    found.coarse = most_dropped(search, found.format, measured);
    found.coarse_extra_box_tests_pct = measured.extra(found.format, found.coarse);
  }
  if (rtl::index_of(search.design->ports(found.format), hls::Role::endless)) {
    found.endless_extra_box_tests_pct = measured.extra(found.format, found.coarse, false);
    found.ends = *found.endless_extra_box_tests_pct > search.overhead_pct;
  }
  found.formats_measured = measured.count();
  return found;
}

}  // namespace hitpipe::sim
