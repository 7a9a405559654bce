#include "sim/fit/fit_scene.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "rtl_gen/emit/unit_folder.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim {

namespace {

bool meets_a_triangle(const ref::Recording& rays) {
  return std::any_of(rays.batches.begin(), rays.batches.end(), [](const ref::RecordedBatch& batch) {
    return std::any_of(batch.triangles.begin(), batch.triangles.end(),
                       [](std::uint32_t triangle) { return triangle != ref::Hit::none; });
  });
}

/// Reports that the step begins, and reports its share whenever it is called.
std::function<void(double)> start_step(const FitOptions& options, const std::string& step) {
  options.progress(step, 0.0);
  return [&options, step](double share) { options.progress(step, share); };
}

PrecisionSearch search_of(const rtl::Design& design, const Format& before, const FitScene& scene,
                          const FitOptions& options) {
  return {.design = &design,
          .scene = &scene.scene,
          .bvh = &scene.bvh,
          .demands = &scene.demands,
          .rays = &scene.rays,
          .most = before,
          .overhead_pct = options.overhead_pct,
          .threads = options.threads};
}

PrecisionKey key_of(const Precision& precision) {
  return {precision.format.numbers(), precision.coarse.dropped, precision.ends};
}

/// What is needed beyond the rate that is asked for, as far as units were tried.
struct Tried {
  double full = 0;  ///< the largest share of its cycles in which a unit took a test; 0: none was tried
  std::map<PrecisionKey, double> too_few{};  ///< boxes a second of units that were not enough

  /// Of a unit that makes so many box tests on the scene's rays.
  [[nodiscard]] FitRate rate(const Precision& precision, double box_tests, const FitScene& scene,
                             const FitOptions& options) const {
    FitRate rate = options.rate;
    if (options.rays_per_second <= 0) return rate;
    rate.boxes_per_second =
        options.rays_per_second * box_tests / static_cast<double>(scene.rays.counts.total().rays);
    if (full > 0) rate.boxes_per_second /= full;
    constexpr double beyond = 1 + 1e-9;
    if (const auto at = too_few.find(key_of(precision)); at != too_few.end())
      rate.boxes_per_second = std::max(rate.boxes_per_second, beyond * at->second);
    return rate;
  }
};

std::optional<Precision> precision_of(PrecisionSearch search, const Tried& tried, const FitScene& scene,
                                      const FitOptions& options, const rtl::Library& library) {
  if (options.keep_bits) return std::nullopt;
  const rtl::Design& design = *search.design;
  const bool rated = options.rate.boxes_per_second > 0 || options.rays_per_second > 0;
  if (options.cost || rated) {
    // A rate of boxes alone would be met by the coarsest numbers. Rays bring their extra tests with them.
    search.limited = !options.cost || options.rate.boxes_per_second > 0;
    search.far = rated;
    search.cost = [&](const Precision& precision, const ref::TraceCounts& tests) {
      std::optional<area::Price> price =
          price_of_fit(design, precision, scene.demands, library,
                       tried.rate(precision, static_cast<double>(tests.box_tests), scene, options));
      if (!price) return std::numeric_limits<double>::infinity();
      if (rated) return static_cast<double>(price->area_um2) * 1e-6;
      return options.cost(
          {.design = &design, .format = precision.format, .price = std::move(*price), .tests = tests});
    };
  }
  return fewest_bits(search);
}

/// Box tests of a unit on the scene's rays. Nobody asks for them without a rate of rays.
double box_tests_of(const PrecisionSearch& search, const Precision& precision, const FitOptions& options) {
  if (options.rays_per_second <= 0) return 0;
  const double extra = extra_box_tests_pct(search, precision.format, precision.coarse, precision.ends);
  return static_cast<double>(search.rays->counts.total().box_tests) * (1 + extra / 100);
}

/// Makes the unit at that rate and checks it.
FitResult fit_at(const rtl::Design& design, const Format& before, const std::optional<Precision>& precision,
                 const FitScene& scene, const FitOptions& options, const rtl::Library& library,
                 const FitRate& rate) {
  const std::string name(design.name);
  FittedUnit unit = fit(design, before, precision, scene.demands, library, rate);
  std::stable_sort(unit.left_out.begin(), unit.left_out.end(),
                   [](const LeftOut& a, const LeftOut& b) { return a.area_um2 > b.area_um2; });
  const rtl::EmittedDesign emitted = rtl::emit(unit);
  start_step(options, name + ": compiling the Verilog");
  const VerilatedDesign verilated(unit);
  const bool drawn = options.folder.empty() || rtl::write_unit(options.folder / name, emitted).drawn;
  const VectorResult vectors = check_vectors({.verilated = &verilated,
                                              .vectors = options.vectors,
                                              .progress = start_step(options, name + ": sending vectors")});
  CosimResult image = cosimulate(verilated, scene.scene, scene.bvh,
                                 {.width = options.width,
                                  .height = options.height,
                                  .threads = options.threads,
                                  .referee = design.conservative,
                                  .light = options.light,
                                  .scene_demands = &scene.demands,
                                  .progress = start_step(options, name + ": co-simulating")});
  const auto rays =
      static_cast<double>(image.rays_primary + image.rays_secondary + image.rays_shadow - image.rejected);
  const double seconds = static_cast<double>(image.unit.cycles) * unit.price.stage_delay_ps * 1e-12;
  return {std::move(unit), vectors, std::move(image), rays / seconds, drawn};
}

}  // namespace

std::string why_not_fitted(const rtl::Design& design) {
  if (const std::string why = why_not_traced(design); !why.empty()) return why;
  return software_of(design).demand == nullptr ? missing(design, demand_part) : "";
}

Format fit_from(const rtl::Design& design) {
  return software_of(design).fit_from.value_or(design.default_format);
}

FitScene prepare_fit(ref::Scene scene, const FitOptions& options) {
  start_step(options, "building the hierarchy");
  ref::Bvh bvh = ref::make_hierarchy(scene, options.hierarchy).bvh;
  const ref::ViewOptions view{options.width, options.height, options.light};
  ref::SceneDemands demands = ref::scene_demands(scene, bvh, view);
  ref::Recording rays = ref::record_rays(scene, *ref::make_tracer(scene.mesh, bvh, {}),
                                         {.width = options.width,
                                          .height = options.height,
                                          .threads = options.threads,
                                          .light = options.light,
                                          .progress = start_step(options, "tracing the scene's rays")});
  if (!meets_a_triangle(rays))
    throw std::runtime_error(
        fmt::format("scene {}: no ray of the image meets a triangle; a unit fitted to it would be of no use",
                    scene.name));
  return {std::move(scene), std::move(bvh), std::move(demands), std::move(rays)};
}

bool FitResult::verified() const {
  return vectors.mismatches == 0 && image.verified(unit.design->conservative);
}

FitResult fit_to_scene(const rtl::Design& design, const Format& before, const FitScene& scene,
                       const FitOptions& options, const rtl::Library& library) {
  const PrecisionSearch search = search_of(design, before, scene, options);
  Tried tried;
  while (true) {
    start_step(options, std::string(design.name) + ": looking for the fewest bits");
    const std::optional<Precision> precision = precision_of(search, tried, scene, options, library);
    const Precision found = precision.value_or(Precision{.format = before});
    const double box_tests = box_tests_of(search, found, options);
    FitResult result = fit_at(design, before, precision, scene, options, library,
                              tried.rate(found, box_tests, scene, options));
    if (result.rays_per_second >= options.rays_per_second) return result;
    // A unit is not full all the time, when rays begin and end. It needs so much more.
    const auto takes = static_cast<double>(result.unit.price.boxes_per_second());
    const double used =
        result.rays_per_second * box_tests / static_cast<double>(scene.rays.counts.total().rays);
    tried.full = std::max(tried.full, std::min(1.0, used / takes));
    tried.too_few[key_of(found)] = takes;
  }
}

}  // namespace hitpipe::sim
