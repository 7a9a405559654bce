#include "sim/fit/core_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "rtl_gen/core/feature.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/native_core.hpp"
#include "sim/fit/core_cuts.hpp"
#include "sim/fit/world_search.hpp"

namespace hitpipe::sim {

namespace {

constexpr double not_wanted = std::numeric_limits<double>::infinity();
/// The fewest bits, 1 or more, that hold a number.
int bits_for(std::uint64_t number) {
  int bits = 1;
  while (bits < 64 && number >> bits != 0) ++bits;
  return bits;
}

/// Fits a core to scenes that are there in its bits.
class Search {
 public:
  Search(const CoreFitOptions& options, const rtl::Library& library, CoreFit& fit)
      : options_(options), library_(library), fit_(fit) {}

  void run() {
    leave_room();
    if (!options_.fixed.stack) choose_stack();
    if (!options_.fixed.boxes) choose_boxes();
    choose_rest();
  }

  /// Traces the scenes' rays with a core, as C++, which is the Verilog in every cycle.
  CoreRate rate_of(const rtl::CoreOptions& options, const std::vector<CoreFitScene>& scenes) {
    const rtl::Core core = rtl::make_core(options, library_);
    CoreRate rate{.cycles_a_ray = {}, .clock_ps = core.clock_ps};
    const MemoryOptions memory = memory_behind(options_.memory, options);
    for (const CoreFitScene& scene : scenes) {
      NativeCore machine(core);
      CoreBench bench(core, machine, scene.image, memory, {.most_lines = lines_for(memory)});
      std::vector<CoreAnswer> answers(scene.jobs.size());
      bench.run(scene.jobs, answers);
      rate.cycles_a_ray.push_back(static_cast<double>(bench.counts().cycles) /
                                  static_cast<double>(std::max<std::uint64_t>(1, bench.counts().rays)));
    }
    return rate;
  }
  std::int64_t size(const rtl::CoreOptions& options) {
    ++fit_.cores_tried;
    return size_of(area::price(rtl::make_core(options, library_), library_).all, library_);
  }

 private:
  /// Widths that images bound.
  void leave_room() {
    rtl::CoreOptions& core = fit_.core;
    const CoreFixed& fixed = options_.fixed;
    const CoreNeeds needs = needs_of(fit_.scenes);
    const auto at_least = [](const char* option, int& value, bool is_fixed, int least) {
      if (!is_fixed)
        value = least;
      else if (value < least)
        throw std::runtime_error(fmt::format("{} {}: the scenes need {}", option, value, least));
    };
    at_least("--levels", core.levels, fixed.levels, std::max(2, needs.levels));
    at_least("--block-bits", core.address_bits, fixed.block_bits, std::max(4, bits_for(needs.blocks - 1)));
    at_least("--address-bits", core.byte_bits, fixed.byte_bits, core.address_bits + 5);
    at_least("--number-bits", core.number_bits, fixed.number_bits, std::max(4, bits_for(needs.triangles)));
    at_least("--leaf-bits", core.leaf_bits, fixed.leaf_bits,
             std::max(2, bits_for(static_cast<std::uint64_t>(needs.most_in_leaf) + 1)));
    if (!fixed.step_bits)
      core.step_bits = std::min(hls::step_count_bits, std::max(4, bits_for(spare_steps * needs.steps)));
  }

  /// Blocks that the scenes' rays read, against those with `than`.
  double reads(const rtl::CoreOptions& core, const rtl::CoreOptions& than) {
    double sum = 0;
    for (const CoreFitScene& scene : fit_.scenes)
      sum += blocks_a_ray(scene, core) / blocks_a_ray(scene, than);
    return sum / static_cast<double>(fit_.scenes.size());
  }
  double blocks_a_ray(const CoreFitScene& scene, const rtl::CoreOptions& core) {
    const hls::MajorBits boxes = core.bits.boxes();
    const auto key = std::tuple(&scene, boxes.mantissa, boxes.fraction, core.stack_bits);
    const auto known = reads_.find(key);
    if (known != reads_.end()) return known->second;
    const PictureRays rays =
        picture_rays(scene.scene, scene.image,
                     {.world = core.bits.world(), .boxes = boxes, .places = 1 << core.stack_bits},
                     {.width = options_.width, .height = options_.height});
    const double blocks = static_cast<double>(rays.work.nodes_loaded + rays.work.triangles_loaded) /
                          static_cast<double>(rays.work.rays);
    return reads_.emplace(key, blocks).first->second;
  }

  /// Goes on while the size falls and rays read few more blocks. For the rate, while size times blocks falls.
  template <class Change>
  void descend(const Change& change) {
    const auto cost = [&](const rtl::CoreOptions& core) {
      const double more = reads(core, whole_);
      if (options_.goal == CoreGoal::area && more > 1 + options_.overhead_pct / 100) return not_wanted;
      return static_cast<double>(size(core)) * (options_.goal == CoreGoal::area ? 1 : more);
    };
    double best = cost(fit_.core);
    while (true) {
      rtl::CoreOptions next = fit_.core;
      if (!change(next)) return;
      const double cost_of_next = cost(next);
      if (cost_of_next >= best) return;
      best = cost_of_next;
      fit_.core = next;
    }
  }
  void choose_boxes() {
    options_.progress("choosing the boxes' bits");
    descend([](rtl::CoreOptions& core) { return --core.bits.mantissa >= hls::MajorBits::min_mantissa; });
    descend([](rtl::CoreOptions& core) { return --core.bits.box_fraction >= hls::MajorBits::min_fraction; });
  }
  void choose_stack() {
    options_.progress("choosing the stack");
    descend([](rtl::CoreOptions& core) { return --core.stack_bits >= 1; });
  }

  static constexpr int serial = 0;  // what the option has in place of cycles
  const rtl::CoreOption& interval_option_ = rtl::core_option("--triangle-ii");
  const rtl::CoreOption& cache_option_ = rtl::core_option("--cache");

  // Rays in flight, interval and cache. A core that does not reach the rate rules out all that have less of
  // everything.
  struct Size {
    int rays, interval, cache;
    [[nodiscard]] bool within(const Size& other) const {
      const auto speed = [](int cycles) { return cycles == serial ? 1000 : cycles; };
      return rays <= other.rays && speed(interval) >= speed(other.interval) && cache <= other.cache;
    }
    [[nodiscard]] bool within_any(const std::vector<Size>& others) const {
      return std::any_of(others.begin(), others.end(), [&](const Size& other) { return within(other); });
    }
  };
  std::vector<Size> all_sizes() {
    const CoreFixed& fixed = options_.fixed;
    const rtl::CoreOptions& core = fit_.core;
    const auto or_own = [](bool is_fixed, int own, const std::vector<int>& all) {
      return is_fixed ? std::vector{own} : all;
    };
    std::vector<Size> sizes;
    for (const int rays : or_own(fixed.rays, core.rays, {2, 4, 8, 16, 32, 64, 128, 256}))
      for (const int interval :
           or_own(fixed.triangles, interval_option_.get(core), {serial, 24, 16, 8, 6, 4, 3}))
        for (const int cache : or_own(fixed.cache, cache_option_.get(core), options_.caches))
          sizes.push_back({rays, interval, cache});
    std::erase_if(sizes, [&](const Size& size) { return !rtl::is_core(with(size)); });
    return sizes;
  }
  rtl::CoreOptions with(const Size& size) {
    rtl::CoreOptions core = fit_.core;
    core.rays = size.rays;
    interval_option_.set(core, size.interval);
    cache_option_.set(core, size.cache);
    if (!options_.fixed.tag_bits) core.tag_bits = std::max(core.ray_bits(), 1);
    return core;
  }

  void choose_rest() {
    options_.progress("pricing cores");
    const std::vector<Size> sizes = all_sizes();
    std::vector<std::pair<std::int64_t, Size>> all;
    constexpr std::size_t at_once = 16;  // what they have in common is scheduled once
    for (std::size_t first = 0; first < sizes.size(); first += at_once) {
      const std::span some = std::span(sizes).subspan(first, std::min(at_once, sizes.size() - first));
      std::vector<rtl::CoreOptions> cores;
      for (const Size& each : some) cores.push_back(with(each));
      const std::vector<rtl::Core> made = rtl::make_cores(cores, library_);
      for (std::size_t i = 0; i < some.size(); ++i) {
        ++fit_.cores_tried;
        const std::int64_t taken = size_of(area::price(made[i], library_).all, library_);
        if (!options_.most_luts || taken <= *options_.most_luts) all.emplace_back(taken, some[i]);
      }
    }
    if (all.empty())
      throw std::runtime_error("no core that these scenes need fits the chip, by its estimate");
    std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    options_.goal == CoreGoal::area ? take_smallest(all) : take_fastest(all);
  }
  void take_smallest(const std::vector<std::pair<std::int64_t, Size>>& all) {
    std::vector<Size> too_slow;
    double best = 0;
    for (const auto& [taken, each] : all) {
      if (each.within_any(too_slow)) continue;
      const rtl::CoreOptions core = with(each);
      if (options_.rays_per_second > 0) {
        options_.progress(fmt::format("tracing with {} rays in flight", each.rays));
        const double rate = rate_of(core, fit_.scenes).rays_per_second();
        best = std::max(best, rate);
        if (rate < options_.rays_per_second) {
          too_slow.push_back(each);
          continue;
        }
      }
      fit_.core = core;
      slow_down();
      return;
    }
    throw std::runtime_error(
        fmt::format("--rate-rays {:g}: no core reaches it; the fastest traces {:.4g} rays a second",
                    options_.rays_per_second, best));
  }
  /// A clock of twice the period has units of fewer stages.
  void slow_down() {
    if (fit_.core.clock_ps) return;
    rtl::CoreOptions slower = fit_.core;
    slower.clock_ps = 2 * rtl::make_core(fit_.core, library_).clock_ps;
    if (size(slower) >= size(fit_.core)) return;
    if (options_.rays_per_second > 0 &&
        rate_of(slower, fit_.scenes).rays_per_second() < options_.rays_per_second)
      return;
    fit_.core = slower;
  }
  /// With a chip the fastest that it holds, else the most rays a second for the size.
  void take_fastest(const std::vector<std::pair<std::int64_t, Size>>& all) {
    double best = 0;
    std::vector<Size> slower;  // than the best, on a chip
    for (auto each = all.rbegin(); each != all.rend(); ++each) {
      const auto& [taken, size] = *each;
      if (options_.most_luts && size.within_any(slower)) continue;
      const rtl::CoreOptions core = with(size);
      options_.progress(fmt::format("tracing with {} rays in flight", size.rays));
      const double rate = rate_of(core, fit_.scenes).rays_per_second();
      slower.push_back(size);
      const double gain = options_.most_luts ? rate : rate / static_cast<double>(taken);
      if (gain <= best) continue;
      best = gain;
      fit_.core = core;
    }
  }

  const CoreFitOptions& options_;
  const rtl::Library& library_;
  CoreFit& fit_;
  std::map<std::tuple<const CoreFitScene*, int, int, int>, double> reads_;
  rtl::CoreOptions whole_ = fit_.core;  ///< with the usual boxes and stack
};

/// With all that the user chose and no fit does.
rtl::CoreOptions default_core(const rtl::CoreOptions& chosen) {
  rtl::CoreOptions core;
  for (const rtl::Feature* const feature : rtl::all_features())
    for (const rtl::CoreOption& option : feature->options)
      if (std::ranges::find(fitted_options, option.name,
                            &std::pair<std::string_view, bool CoreFixed::*>::first) ==
          std::end(fitted_options))
        option.set(core, option.get(chosen));
  return core;
}

CoreFitScene scene_in(const ref::Scene& scene, const hls::RayBits& bits, const CoreFitOptions& options) {
  CoreFitScene made;
  options.progress("reading " + scene.name + " in " + text_of(bits.world()));
  made.scene = std::make_shared<const ref::IntScene>(ref::int_scene(scene, bits.world(), options.hierarchy));
  made.image = ref::core_image(*made.scene);
  const ref::CoreTracerOptions walking{.world = bits.world(), .boxes = bits.boxes(), .places = 2};
  made.jobs =
      picture_rays(made.scene, made.image, walking, {.width = options.width, .height = options.height}).jobs;
  const ref::CoreTracer tracer(made.image, made.scene->mesh.mesh, walking);
  for (const CoreJob& job : made.jobs) {
    std::uint32_t triangle = 0;
    ref::TraceCounts counts;
    tracer.trace({{&job.ray, 1}, job.any ? ref::Query::any : ref::Query::closest, {&triangle, 1}}, counts);
    made.most_steps = std::max(made.most_steps, counts.nodes_loaded);
  }
  return made;
}

}  // namespace

const TriedWorld* CoreFit::taken() const {
  const auto found = std::ranges::find_if(tried, &TriedWorld::taken);
  return found == tried.end() ? nullptr : &*found;
}

double CoreRate::rays_per_second() const {
  const double slowest = *std::max_element(cycles_a_ray.begin(), cycles_a_ray.end());
  return 1e12 / clock_ps / slowest;
}

std::int64_t size_of(const area::CorePartPrice& price, const rtl::Library& library) {
  // Bits of memory: a RAM32M has 192 in four tables. A chip without them has few small memories and many registers. In
  // standard cells a bit is six transistors.
  constexpr std::int64_t bits_of_ram = 48, bits_without_ram = 8, bit_um2 = 5;
  const rtl::Chip* const chip = library.chip();
  if (chip == nullptr) return price.area_um2 + bit_um2 * price.memory_bits;
  return price.taken.luts + price.memory_bits / (chip->packs_registers ? bits_without_ram : bits_of_ram);
}

CoreFit fit_core(const std::vector<ref::Scene>& scenes, const CoreFitOptions& options,
                 const rtl::Library& library) {
  CoreFit fit{.before = options.core,
              .core = options.core,
              .price_before = {},
              .price = {},
              .rate_before = {},
              .rate = {},
              .tried = {},
              .cuts = {},
              .scenes = {}};
  if (!options.fixed.world) {
    fit.tried = search_world(scenes, options);
    fit.core.bits = with_world(fit.core.bits, fit.taken()->bits);
  }
  for (const ref::Scene& scene : scenes) fit.scenes.push_back(scene_in(scene, fit.core.bits, options));
  Search search(options, library, fit);
  search.run();
  fit.price = area::price(rtl::make_core(fit.core, library), library);
  options.progress("tracing with the fitted core");
  fit.rate = search.rate_of(fit.core, fit.scenes);

  fit.before = default_core(options.core);
  std::vector<CoreFitScene> usual;
  for (const ref::Scene& scene : scenes) {
    usual.push_back(scene_in(scene, fit.before.bits, options));
    make_room(fit.before, usual.back().image);
  }
  fit.price_before = area::price(rtl::make_core(fit.before, library), library);
  options.progress("tracing with the default core");
  fit.rate_before = search.rate_of(fit.before, usual);
  fit.cuts = cuts_of(fit, options, library);
  return fit;
}

}  // namespace hitpipe::sim
