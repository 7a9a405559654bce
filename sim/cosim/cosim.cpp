#include "sim/cosim/cosim.hpp"

#include <algorithm>
#include <deque>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>

#include "host/parallel.hpp"
#include "sim/cosim/ray_unit.hpp"
#include "sim/feeds/step_feed.hpp"
#include "sw_ref/judge/box_referee.hpp"
#include "sw_ref/quantise/guard.hpp"
#include "sw_ref/render/whitted.hpp"
#include "sw_ref/trace/slabs.hpp"

namespace hitpipe::sim {

namespace {

constexpr int tile_side = 64;

double per_second(std::uint64_t count, double seconds) {
  return seconds > 0 ? static_cast<double>(count) / seconds : 0.0;
}

struct Frame {
  const VerilatedDesign& verilated;
  const ref::Scene& scene;
  const ref::Bvh& bvh;
  const CosimOptions& options;
  const SceneFeed& feed;
  const ref::Whitted& whitted;
};

/// One tile of the image. Its primary rays come in rows. The rays that a ray causes follow as soon as it
/// ends.
class Tile {
 public:
  Tile(const Frame& frame, int left, int top)
      : frame_(frame),
        left_(left),
        top_(top),
        width_(std::min(tile_side, frame.options.width - left)),
        height_(std::min(tile_side, frame.options.height - top)),
        light_(pixels()),
        triangles_(pixels(), ref::Hit::none) {}

  /// Fills the tile's part of the result's image and returns its counts.
  CosimResult run(CosimResult& frame_result) {
    CosimResult counts;
    const rtl::Design& design = *frame_.verilated.unit().design;
    const rtl::Format& format = frame_.verilated.unit().format;
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
             [&](const RayJob& job, const ref::Hit& hit) {
               traced_.push_back({job.ray, job.query, hit.triangle});
               ended(job.id, hit.triangle);
             });
    counts.loop_seconds = host::thread_seconds() - start;
    counts.rtl_seconds = unit.rtl_seconds();
    counts.unit = unit.counts();
    compare(counts);
    for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
      const std::size_t at = static_cast<std::size_t>(top_ + static_cast<int>(pixel) / width_) *
                                 static_cast<std::size_t>(frame_.options.width) +
                             static_cast<std::size_t>(left_ + static_cast<int>(pixel) % width_);
      frame_result.triangles[at] = triangles_[pixel];
      frame_result.image[at] = light_[pixel].value();
    }
    return counts;
  }

 private:
  /// A ray that went through the unit, and its result. It is traced again in software.
  struct Traced {
    ref::Ray ray;
    ref::Query query;
    std::uint32_t triangle;
  };

  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }

  /// The next task to trace. Rays caused by ended rays come before new primary rays. Nothing at the end.
  std::optional<ref::RayTask> next_task() {
    if (!waiting_.empty()) {
      const ref::RayTask task = waiting_.front();
      waiting_.pop_front();
      return task;
    }
    if (next_pixel_ == pixels()) return std::nullopt;
    const int x = left_ + static_cast<int>(next_pixel_) % width_;
    const int y = top_ + static_cast<int>(next_pixel_) / width_;
    return frame_.whitted.primary(x, y, frame_.options.width, frame_.options.height,
                                  static_cast<std::uint32_t>(next_pixel_++));
  }

  std::optional<RayJob> next(CosimResult& counts) {
    while (const std::optional<ref::RayTask> task = next_task()) {
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
    const ref::RayTask& task = tasks_[id];
    if (task.kind == ref::RayKind::primary) triangles_[task.pixel] = triangle;
    caused_.clear();
    frame_.whitted.end(task, triangle, light_[task.pixel], caused_);
    waiting_.insert(waiting_.end(), caused_.begin(), caused_.end());
    free_ids_.push_back(id);
  }

  void compare(CosimResult& counts) const {
    for (const Traced& t : traced_) {
      const ref::Hit hit =
          ref::trace<ref::ConservativeSlabs>(frame_.bvh, frame_.scene.mesh, t.ray, t.query, counts.reference);
      const bool same = t.query == ref::Query::any ? hit.found() == (t.triangle != ref::Hit::none)
                                                   : hit.triangle == t.triangle;
      counts.different_triangles += same ? 0 : 1;
    }
  }

  const Frame& frame_;
  int left_;
  int top_;
  int width_;
  int height_;
  std::size_t next_pixel_ = 0;
  std::vector<ref::RayTask> tasks_;      // by id; those that have started and not ended
  std::vector<std::uint32_t> free_ids_;  // of ended tasks
  std::deque<ref::RayTask> waiting_;
  std::vector<ref::RayTask> caused_;
  std::vector<Traced> traced_;
  std::vector<ref::LightSum> light_;      // by pixel of the tile
  std::vector<std::uint32_t> triangles_;  // by pixel of the tile
};

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
  if (options.width < 1 || options.height < 1)
    throw std::invalid_argument(
        fmt::format("image of {} x {} pixels: allowed is 1 x 1 and more", options.width, options.height));
  const Unit& unit = verilated.unit();
  std::unique_ptr<SceneFeed> feed = make_feed(*unit.design, unit.format, bvh, unit.coarse);
  if (!unit.ends) feed = with_step(std::move(feed), endless_step(unit.ports()));
  if (!unit.demands.empty()) feed = with_step(std::move(feed), DemandGuard(unit.demands, unit.ports()));
  const ref::Whitted whitted(scene, options.light);
  const Frame frame{verilated, scene, bvh, options, *feed, whitted};
  CosimResult result;
  result.unit = UnitCounts::zeros(options.referee);
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  result.image.resize(pixels);
  result.triangles.resize(pixels);
  const int columns = (options.width + tile_side - 1) / tile_side;
  const int rows = (options.height + tile_side - 1) / tile_side;
  std::vector<CosimResult> parts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const auto run_tile = [&](std::size_t i) {
    const int column = static_cast<int>(i) % columns;
    const int row = static_cast<int>(i) / columns;
    parts[i] = Tile(frame, column * tile_side, row * tile_side).run(result);
  };
  host::for_each_index(parts.size(), options.threads, run_tile, options.progress);
  for (const CosimResult& part : parts) {
    result.rays_primary += part.rays_primary;
    result.rays_secondary += part.rays_secondary;
    result.rays_shadow += part.rays_shadow;
    result.rejected += part.rejected;
    result.different_triangles += part.different_triangles;
    result.unit += part.unit;
    result.reference += part.reference;
    result.rtl_seconds += part.rtl_seconds;
    result.loop_seconds += part.loop_seconds;
  }
  result.latency = verilated.latency();
  result.interval = unit.pipeline.interval();
  return result;
}

}  // namespace hitpipe::sim
