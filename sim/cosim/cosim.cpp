#include "sim/cosim/cosim.hpp"

#include <algorithm>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "rays/exact/box_referee.hpp"
#include "rays/trace/slabs.hpp"
#include "sim/cosim/ray_source.hpp"
#include "sim/cosim/ray_unit.hpp"
#include "sim/software/step_feed.hpp"
#include "sim/unit/unit_set_up.hpp"
#include "sw_ref/quantise/guard.hpp"
#include "sw_ref/trace/traversal.hpp"

namespace hitpipe::sim {

namespace {

double per_second(std::uint64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds : 0.0;
}

struct Frame {
  const VerilatedDesign& verilated;
  const ref::Scene& scene;
  const ref::Bvh& bvh;
  const CosimOptions& options;
  const SceneFeed& feed;
};

/// Takes the rays of a source through a unit of its own, and then through software.
class Part {
 public:
  Part(const Frame& frame, RaySource& source) : frame_(frame), source_(source) {}

  CosimResult run() {
    CosimResult counts;
    const rtl::Design& design = *frame_.verilated.unit().design;
    const Format& format = frame_.verilated.unit().format;
    RayUnit unit(
        {.verilated = &frame_.verilated,
         .evaluate = design.evaluate(format),
         .on_float_unit = frame_.options.bit_level ? std::nullopt : design.evaluate_on_float_unit(format),
         .feed = &frame_.feed,
         .bvh = &frame_.bvh,
         .mesh = &frame_.scene.mesh,
         .rays_in_flight = frame_.options.rays_in_flight,
         .referee = frame_.options.referee});
    const double start = host::thread_seconds();
    unit.run([&] { return next(counts); },
             [&](const RayJob& job, const RayAnswer& answer) {
               traced_.push_back({job.ray, job.query, tasks_[job.id].pixel, answer});
               ended(job.id, answer.hit.triangle);
             });
    counts.loop_seconds = host::thread_seconds() - start;
    counts.rtl_seconds = unit.rtl_seconds();
    counts.unit = unit.counts();
    compare(counts);
    return counts;
  }

 private:
  /// A ray that went through the unit, and its result. It is traced again in software.
  struct Traced {
    ref::Ray ray;
    ref::Query query;
    std::uint32_t pixel;  ///< or its number in the list
    RayAnswer answer;
  };

  std::optional<RayJob> next(CosimResult& counts) {
    while (const std::optional<ref::RayTask> task = source_.next()) {
      if (frame_.options.scene_demands != nullptr)
        ref::check_ray_against(*frame_.options.scene_demands, task->kind, task->ray);
      count_of(task->kind, counts) += 1;
      const std::uint32_t id = keep(*task);
      if (ref::acceptable(task->ray)) return RayJob{task->ray, task->query(), id};
      ++counts.rejected;
      ended(id, ref::Hit::none);
    }
    return std::nullopt;
  }

  static std::uint64_t& count_of(ref::RayKind kind, CosimResult& counts) {
    return kind == ref::RayKind::primary     ? counts.rays_primary
           : kind == ref::RayKind::secondary ? counts.rays_secondary
                                             : counts.rays_shadow;
  }

  /// Gives a number to a task that starts. Numbers of ended tasks are used again.
  std::uint32_t keep(const ref::RayTask& task) {
    if (free_ids_.empty()) {
      tasks_.push_back(task);
      return static_cast<std::uint32_t>(tasks_.size() - 1);
    }
    const std::uint32_t id = free_ids_.back();
    free_ids_.pop_back();
    tasks_[id] = task;
    return id;
  }

  void ended(std::uint32_t id, std::uint32_t triangle) {
    source_.ended(tasks_[id], triangle);
    free_ids_.push_back(id);
  }

  void compare(CosimResult& counts) {
    std::ranges::stable_sort(traced_, {}, &Traced::pixel);
    for (auto first = traced_.begin(); first != traced_.end();) {
      const auto last =
          std::find_if(first, traced_.end(), [&](const Traced& t) { return t.pixel != first->pixel; });
      compare_pixel({first, last}, counts);
      first = last;
    }
  }
  void compare_pixel(std::span<const Traced> rays, CosimResult& counts) const {
    std::uint64_t box_tests = 0, triangle_tests = 0;
    ref::TraceCounts reference;
    for (const Traced& t : rays) {
      const ref::Hit hit =
          ref::trace<ref::ConservativeSlabs>(frame_.bvh, frame_.scene.mesh, t.ray, t.query, reference);
      counts.different_triangles += ref::same_answer(t.query, t.answer.hit.triangle, hit.triangle) ? 0 : 1;
      box_tests += t.answer.box_tests;
      triangle_tests += t.answer.triangle_tests;
    }
    counts.extra_box_tests.add(box_tests, reference.box_tests);
    counts.extra_triangle_tests.add(triangle_tests, reference.triangle_tests);
    counts.reference += reference;
  }

  const Frame& frame_;
  RaySource& source_;
  std::vector<ref::RayTask> tasks_;      // by id; those that have started and not ended
  std::vector<std::uint32_t> free_ids_;  // of ended tasks
  std::vector<Traced> traced_;
};

/// The counts of each tile, which also draws its part of the result's image.
std::vector<CosimResult> run_picture(const Frame& frame, CosimResult& result) {
  const CosimOptions& options = frame.options;
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  result.image.resize(pixels);
  result.triangles.resize(pixels);
  const ref::Whitted whitted(frame.scene, options.light);
  const TileRays::Picture picture{&whitted, options.width, options.height, {result.image, result.triangles}};
  const int columns = (options.width + TileRays::side - 1) / TileRays::side;
  const int rows = (options.height + TileRays::side - 1) / TileRays::side;
  std::vector<CosimResult> parts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto run_tile = [&](std::size_t i) {
    const int column = static_cast<int>(i) % columns;
    const int row = static_cast<int>(i) / columns;
    TileRays tile(picture, column * TileRays::side, row * TileRays::side);
    parts[i] = Part(frame, tile).run();
    tile.draw();
  };
  host::for_each_index(parts.size(), options.threads, run_tile, options.progress);
  return parts;
}

std::vector<CosimResult> run_list(const Frame& frame, CosimResult& result) {
  const std::span<const AskedRay> rays = frame.options.rays;
  result.triangles.resize(rays.size());
  std::vector<CosimResult> parts((rays.size() + ListRays::most - 1) / ListRays::most);
  const auto run_part = [&](std::size_t i) {
    ListRays list(rays, i * ListRays::most, result.triangles);
    parts[i] = Part(frame, list).run();
  };
  host::for_each_index(parts.size(), frame.options.threads, run_part, frame.options.progress);
  return parts;
}

}  // namespace

double CosimResult::occupancy_pct() const {
  if (unit.cycles == 0) return 0.0;
  return 100.0 * interval * static_cast<double>(unit.tests) / static_cast<double>(unit.cycles);
}

double CosimResult::extra_box_tests_pct() const {
  return percent_above(unit.box_tests, reference.box_tests);
}

double CosimResult::extra_triangle_tests_pct() const {
  return percent_above(unit.triangle_tests, reference.triangle_tests);
}

double CosimResult::rtl_tests_per_s() const {
  return per_second(unit.tests, rtl_seconds);
}

double CosimResult::loop_tests_per_s() const {
  return per_second(unit.tests, loop_seconds);
}

double CosimResult::rtl_boxes_per_s() const {
  return per_second(unit.box_tests, rtl_seconds);
}

double CosimResult::loop_boxes_per_s() const {
  return per_second(unit.box_tests, loop_seconds);
}

bool CosimResult::same_as_software() const {
  return unit.rtl_mismatches == 0 && different_triangles == 0;
}

std::optional<bool> CosimResult::without_false_miss() const {
  if (!unit.false_misses) return std::nullopt;
  return *unit.false_misses == 0;
}

bool CosimResult::verified(bool conservative) const {
  return same_as_software() && (!conservative || without_false_miss() == true);
}

CosimResult cosimulate(const VerilatedDesign& verilated, const ref::Scene& scene, const ref::Bvh& bvh,
                       const CosimOptions& options) {
  if (options.rays.empty() && (options.width < 1 || options.height < 1))
    throw std::invalid_argument(
        fmt::format("image of {} x {} pixels: allowed is 1 x 1 and more", options.width, options.height));
  const rtl::Unit& unit = verilated.unit();
  std::unique_ptr<SceneFeed> feed = make_feed(*unit.design, unit.format, bvh, coarse_axes(unit));
  if (!takes_ends(unit)) feed = with_step(std::move(feed), endless_step(unit.ports()));
  if (!unit.demands.empty()) feed = with_step(std::move(feed), DemandGuard(unit.demands, unit.ports()));
  const Frame frame{verilated, scene, bvh, options, *feed};
  CosimResult result;
  result.unit = UnitCounts::zeros(options.referee);
  const std::vector<CosimResult> parts =
      options.rays.empty() ? run_picture(frame, result) : run_list(frame, result);
  for (const CosimResult& part : parts) {
    result.rays_primary += part.rays_primary;
    result.rays_secondary += part.rays_secondary;
    result.rays_shadow += part.rays_shadow;
    result.rejected += part.rejected;
    result.different_triangles += part.different_triangles;
    result.unit += part.unit;
    result.reference += part.reference;
    result.extra_box_tests += part.extra_box_tests;
    result.extra_triangle_tests += part.extra_triangle_tests;
    result.rtl_seconds += part.rtl_seconds;
    result.loop_seconds += part.loop_seconds;
  }
  result.latency = verilated.latency();
  result.interval = unit.pipeline->interval();
  return result;
}

}  // namespace hitpipe::sim
