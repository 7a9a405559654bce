#include "sim/fit/core_fit.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "hls/num/width.hpp"
#include "rtl_gen/catalogue/format.hpp"
#include "sim/core/core_trace.hpp"
#include "sim/core/native_core.hpp"
#include "sw_ref/world/int_error.hpp"

namespace hitpipe::sim {

namespace {

constexpr double endless = std::numeric_limits<double>::infinity();
/// Steps that a ray may make, against the most that one of the pictures makes: other rays go other ways.
constexpr std::uint64_t spare_steps = 16;

std::string text_of(const hls::WorldBits& world) {
  return rtl::to_string(rtl::Format(world));
}

hls::RayBits with_world(hls::RayBits bits, const hls::WorldBits& world) {
  bits.coord = world.coord;
  bits.finer = world.finer;
  bits.slope = world.slope;
  bits.fraction = world.fraction;
  bits.box_fraction = std::min(bits.box_fraction, world.finer + world.fraction);
  return bits;
}

/// The fewest bits, 1 or more, that hold a number.
int bits_for(std::uint64_t number) {
  int bits = 1;
  while (bits < 64 && number >> bits != 0) ++bits;
  return bits;
}

std::string boxes_text(const hls::RayBits& bits) {
  return fmt::format("/{}", bits.mantissa) +
         (bits.box_fraction == 0 ? "" : fmt::format("f{}", bits.box_fraction));
}

// The search for bits of coordinates.

class WorldSearch {
 public:
  WorldSearch(const std::vector<ref::Scene>& scenes, const CoreFitOptions& options)
      : scenes_(scenes), options_(options) {}

  /// The fewest bits of a corner with one finer bit of origins and as many bits of a slope. Then fewer of a slope, and no
  /// finer bit, if the error allows it.
  hls::WorldBits fewest() {
    int least = hls::WorldBits::min_coord, most = hls::WorldBits::max_coord;
    if (error(usual(most)) > options_.error_pct)
      throw std::runtime_error(
          fmt::format("--error {:g}: {:g} % of the rays differ with {}; allowed is that or more",
                      options_.error_pct, error(usual(most)), text_of(usual(most))));
    while (least < most) {
      const int middle = (least + most) / 2;
      if (error(usual(middle)) <= options_.error_pct)
        most = middle;
      else
        least = middle + 1;
    }
    hls::WorldBits best = usual(least);
    const auto improve = [&](const auto& change) {
      hls::WorldBits next = best;
      change(next);
      if (!next.valid() || error(next) > options_.error_pct) return false;
      best = next;
      return true;
    };
    improve([](hls::WorldBits& bits) { bits.finer = 0; });
    while (improve([](hls::WorldBits& bits) { --bits.slope; })) {
    }
    for (TriedWorld& each : tried_) each.taken = each.bits == best;
    return best;
  }
  [[nodiscard]] std::vector<TriedWorld> tried() && { return std::move(tried_); }

 private:
  static hls::WorldBits usual(int coord) { return {coord, 1, coord}; }

  double error(const hls::WorldBits& bits) {
    for (const TriedWorld& each : tried_)
      if (each.bits == bits) return each.error_pct;
    options_.progress("comparing rays in " + text_of(bits));
    double most = 0;
    for (const ref::Scene& scene : scenes_) {
      ref::IntErrorOptions measured;
      measured.world = bits;
      measured.width = options_.width;
      measured.height = options_.height;
      measured.hierarchy = options_.hierarchy;
      const ref::IntError found = ref::int_error(scene, measured);
      most =
          std::max(most, 100.0 * static_cast<double>(found.different_rays) / static_cast<double>(found.rays));
    }
    tried_.push_back({bits, most});
    return most;
  }

  const std::vector<ref::Scene>& scenes_;
  const CoreFitOptions& options_;
  std::vector<TriedWorld> tried_;
};

// What the images need, by bounds.

/// Of all scenes' headers the most.
ref::CoreHeader needs_of(const std::vector<CoreFitScene>& scenes) {
  ref::CoreHeader all;
  for (const CoreFitScene& scene : scenes) {
    const ref::CoreHeader& one = scene.image.header;
    all.levels = std::max(all.levels, one.levels);
    all.triangles = static_cast<std::uint32_t>(std::max<std::uint64_t>(all.triangles, one.in_source()));
    all.most_in_leaf = std::max(all.most_in_leaf, one.most_in_leaf);
  }
  return all;
}

std::uint64_t most_blocks(const std::vector<CoreFitScene>& scenes) {
  std::uint64_t most = 0;
  for (const CoreFitScene& scene : scenes) most = std::max<std::uint64_t>(most, scene.image.blocks.size());
  return most;
}

std::uint64_t most_steps(const std::vector<CoreFitScene>& scenes) {
  std::uint64_t most = 0;
  for (const CoreFitScene& scene : scenes) most = std::max(most, scene.most_steps);
  return most;
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
    const ref::CoreHeader needs = needs_of(fit_.scenes);
    const auto at_least = [](const char* option, int& value, bool is_fixed, int least) {
      if (!is_fixed)
        value = least;
      else if (value < least)
        throw std::runtime_error(fmt::format("{} {}: the scenes need {}", option, value, least));
    };
    at_least("--levels", core.levels, fixed.levels, std::max(2, needs.levels));
    at_least("--block-bits", core.address_bits, fixed.block_bits,
             std::max(4, bits_for(most_blocks(fit_.scenes) - 1)));
    at_least("--address-bits", core.byte_bits, fixed.byte_bits, core.address_bits + 5);
    at_least("--number-bits", core.number_bits, fixed.number_bits, std::max(4, bits_for(needs.triangles)));
    at_least("--leaf-bits", core.leaf_bits, fixed.leaf_bits, std::max(2, bits_for(needs.most_in_leaf + 1U)));
    if (!fixed.step_bits)
      core.step_bits =
          std::min(hls::step_count_bits, std::max(4, bits_for(spare_steps * most_steps(fit_.scenes))));
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
      if (options_.goal == CoreGoal::area && more > 1 + options_.overhead_pct / 100) return endless;
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

  // Rays in flight, interval and cache. A core that does not reach the rate rules out all that have less of
  // everything.
  struct Size {
    int rays, interval, cache;
    [[nodiscard]] bool within(const Size& other) const {
      const auto speed = [](int cycles) { return cycles == 0 ? 1000 : cycles; };
      return rays <= other.rays && speed(interval) >= speed(other.interval) && cache <= other.cache;
    }
  };
  std::vector<Size> all_sizes() const {
    const CoreFixed& fixed = options_.fixed;
    const rtl::CoreOptions& core = fit_.core;
    const auto or_own = [](bool is_fixed, int own, std::vector<int> all) {
      return is_fixed ? std::vector{own} : all;
    };
    const bool units_only = core.weights || core.questions;
    std::vector<int> intervals{0, 24, 16, 8, 6, 4, 3};
    if (units_only) intervals.erase(intervals.begin());
    std::vector<Size> sizes;
    for (const int rays : or_own(fixed.rays, core.rays, {2, 4, 8, 16, 32, 64, 128, 256}))
      for (const int interval : or_own(fixed.triangles, core.triangle_interval, intervals))
        for (const int cache : or_own(fixed.cache, core.cache_kib, options_.caches))
          sizes.push_back({rays, interval, cache});
    return sizes;
  }
  rtl::CoreOptions with(const Size& size) {
    rtl::CoreOptions core = fit_.core;
    core.rays = size.rays;
    core.triangle_interval = size.interval;
    core.cache_kib = size.cache;
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
      if (std::any_of(too_slow.begin(), too_slow.end(), [&](const Size& slow) { return each.within(slow); }))
        continue;
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
      if (options_.most_luts &&
          std::any_of(slower.begin(), slower.end(), [&](const Size& slow) { return size.within(slow); }))
        continue;
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

/// With the features that the user chose.
rtl::CoreOptions default_core(const rtl::CoreOptions& chosen) {
  rtl::CoreOptions core;
  core.door = chosen.door;
  core.rings = chosen.rings;
  core.weights = chosen.weights;
  core.questions = chosen.questions;
  core.data_bits = chosen.data_bits;
  core.in_order = chosen.in_order;
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

/// What each cut saves: the fitted core without it. Cuts that save nothing are not listed.
void list_cuts(CoreFit& fit, const CoreFitOptions& options, const rtl::Library& library) {
  const ref::CoreHeader needs = needs_of(fit.scenes);
  const rtl::CoreOptions &was = fit.before, &is = fit.core;
  const auto cut = [&](std::string what, std::string why, const auto& undo) {
    CoreCut made{std::move(what), std::move(why), is, {}};
    undo(made.before);
    try {
      made.without = area::price(rtl::make_core(made.before, library), library).all;
    } catch (const std::runtime_error&) {
      return;  // no such core
    }
    if (size_of(made.without, library) != size_of(fit.price.all, library))
      fit.cuts.push_back(std::move(made));
  };
  if (!(was.bits.world() == is.bits.world()))
    cut(fmt::format("coordinates {} of {}", text_of(is.bits.world()), text_of(was.bits.world())),
        options.fixed.world
            ? "as asked"
            : fmt::format("at most {:g} % of the rays find another triangle", options.error_pct),
        [&](rtl::CoreOptions& core) { core.bits = with_world(is.bits, was.bits.world()); });
  const auto number = [&](const char* what, int rtl::CoreOptions::*field, bool fixed, std::string why) {
    if (is.*field == was.*field) return;
    cut(fmt::format("{}: {} of {}", what, is.*field, was.*field), fixed ? "as asked" : std::move(why),
        [&](rtl::CoreOptions& core) { core.*field = was.*field; });
  };
  const CoreFixed& fixed = options.fixed;
  const std::string by_size = options.goal == CoreGoal::rate
                                  ? "least size times blocks that are read"
                                  : fmt::format("at most {:g} % more blocks are read", options.overhead_pct);
  if (is.bits.mantissa != was.bits.mantissa || is.bits.box_fraction != was.bits.box_fraction)
    cut(fmt::format("boxes {} of {}", boxes_text(is.bits), boxes_text(was.bits)),
        fixed.boxes ? "as asked" : by_size, [&](rtl::CoreOptions& core) {
          core.bits.mantissa = was.bits.mantissa;
          core.bits.box_fraction = std::min(was.bits.box_fraction, core.bits.finer + core.bits.fraction);
        });
  number("levels", &rtl::CoreOptions::levels, fixed.levels,
         fmt::format("a path has {} records", needs.levels));
  number("bits of a block's number", &rtl::CoreOptions::address_bits, fixed.block_bits,
         fmt::format("{} blocks", most_blocks(fit.scenes)));
  number("bits of an address", &rtl::CoreOptions::byte_bits, fixed.byte_bits, "a memory for one image");
  number("bits of a tag", &rtl::CoreOptions::tag_bits, fixed.tag_bits, "rays in flight have different ones");
  number("bits of a triangle's number", &rtl::CoreOptions::number_bits, fixed.number_bits,
         fmt::format("{} triangles", needs.triangles));
  number("bits of a leaf's count", &rtl::CoreOptions::leaf_bits, fixed.leaf_bits,
         fmt::format("a leaf has at most {} triangles", needs.most_in_leaf));
  number("bits of the steps", &rtl::CoreOptions::step_bits, fixed.step_bits,
         fmt::format("{} times the {} of a ray of the pictures", spare_steps, most_steps(fit.scenes)));
  if (is.stack_bits != was.stack_bits)
    cut(fmt::format("places of a stack: {} of {}", 1 << is.stack_bits, 1 << was.stack_bits),
        fixed.stack ? "as asked" : by_size,
        [&](rtl::CoreOptions& core) { core.stack_bits = was.stack_bits; });
  const std::string by_rate = options.rays_per_second > 0
                                  ? fmt::format("{:g} rays a second", options.rays_per_second)
                              : options.goal == CoreGoal::rate ? "most rays a second"
                                                               : "no rate is asked for";
  number("rays in flight", &rtl::CoreOptions::rays, fixed.rays, by_rate);
  const auto interval = [](int cycles) {
    return cycles == 0 ? std::string("serial") : std::to_string(cycles);
  };
  if (is.triangle_interval != was.triangle_interval)
    cut(fmt::format("cycles a triangle: {} of {}", interval(is.triangle_interval),
                    interval(was.triangle_interval)),
        fixed.triangles ? "as asked" : by_rate,
        [&](rtl::CoreOptions& core) { core.triangle_interval = was.triangle_interval; });
  number("KiB of the cache", &rtl::CoreOptions::cache_kib, fixed.cache, by_rate);
  if (is.clock_ps != was.clock_ps)
    cut(fmt::format("a clock of {} ps", is.clock_ps.value_or(0)),
        options.core.clock_ps ? "as asked" : by_rate,
        [&](rtl::CoreOptions& core) { core.clock_ps = was.clock_ps; });
  std::stable_sort(fit.cuts.begin(), fit.cuts.end(), [&](const CoreCut& a, const CoreCut& b) {
    return size_of(a.without, library) > size_of(b.without, library);
  });
}

}  // namespace

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
    WorldSearch search(scenes, options);
    fit.core.bits = with_world(fit.core.bits, search.fewest());
    fit.tried = std::move(search).tried();
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
  list_cuts(fit, options, library);
  return fit;
}

}  // namespace hitpipe::sim
