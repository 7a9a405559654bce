#include "sim/cosim.hpp"

#include <algorithm>
#include <atomic>
#include <deque>
#include <memory>

#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <time.h>

#include "sw_ref/exact/box_referee.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/shade.hpp"
#include "sw_ref/traverse/slabs.hpp"

namespace hitpipe::sim {

namespace {

constexpr int tile_side = 64;

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double percent_above(std::uint64_t value, std::uint64_t reference) {
  return reference == 0 ? 0.0 : 100.0 * (static_cast<double>(value) / static_cast<double>(reference) - 1.0);
}

struct Frame {
  const rtl::Design& design;
  rtl::Format format;
  const VerilatedDesign& verilated;
  const ref::Scene& scene;
  const ref::Bvh& bvh;
  const CosimOptions& options;
  const SceneFeed& feed;
};

/// A ray that went through the unit and what came of it, to be traced again in software.
struct Traced {
  ref::Ray ray;
  ref::Query query;
  std::uint32_t triangle;
};

/// One tile of the image: its primary rays in rows, each followed by its shadow rays as soon as it ends.
class Tile {
 public:
  Tile(const Frame& frame, int left, int top)
      : frame_(frame),
        left_(left),
        top_(top),
        width_(std::min(tile_side, frame.options.width - left)),
        height_(std::min(tile_side, frame.options.height - top)),
        points_(pixels()),
        blocked_(pixels() * frame.scene.lights.size(), true),
        triangles_(pixels(), ref::Hit::none) {}

  /// Fills the tile's part of the result's image and returns its counts.
  CosimResult run(CosimResult& frame_result) {
    CosimResult counts;
    RayUnit unit({.verilated = &frame_.verilated,
                  .evaluate = frame_.design.evaluate(frame_.format),
                  .feed = &frame_.feed,
                  .bvh = &frame_.bvh,
                  .mesh = &frame_.scene.mesh,
                  .rays_in_flight = frame_.options.rays_in_flight,
                  .referee = frame_.options.referee});
    const double start = thread_seconds();
    unit.run([&] { return next(counts); },
             [&](const RayJob& job, const ref::Traversal& traversal) { ended(job, traversal); });
    counts.rtl_seconds = thread_seconds() - start;
    counts.unit = unit.counts();
    compare(counts);
    shade(frame_result);
    return counts;
  }

 private:
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  }

  [[nodiscard]] ref::Ray primary(std::size_t pixel) const {
    const int x = left_ + static_cast<int>(pixel) % width_;
    const int y = top_ + static_cast<int>(pixel) / width_;
    return ref::primary_ray(frame_.scene.camera, x, y, frame_.options.width, frame_.options.height);
  }

  std::optional<RayJob> next(CosimResult& counts) {
    while (!shadows_.empty() || next_pixel_ < pixels()) {
      RayJob job;
      if (!shadows_.empty()) {
        job = shadows_.front();
        shadows_.pop_front();
        ++counts.rays_shadow;
      } else {
        job = {.ray = primary(next_pixel_),
               .query = ref::Query::closest,
               .id = static_cast<std::uint32_t>(next_pixel_)};
        ++next_pixel_;
        ++counts.rays_primary;
      }
      if (ref::acceptable(job.ray)) return job;
      ++counts.rejected;
      if (job.query == ref::Query::any) blocked_[job.id] = false;
    }
    return std::nullopt;
  }

  void ended(const RayJob& job, const ref::Traversal& traversal) {
    const ref::Hit& hit = traversal.hit();
    traced_.push_back({job.ray, job.query, hit.triangle});
    if (job.query == ref::Query::any) {
      blocked_[job.id] = hit.found();
      return;
    }
    triangles_[job.id] = hit.triangle;
    if (!hit.found()) return;
    points_[job.id] = ref::surface_point(frame_.scene.mesh, hit.triangle, job.ray);
    for (std::size_t light = 0; light < frame_.scene.lights.size(); ++light) {
      const auto ray = ref::shadow_ray(points_[job.id], frame_.scene.lights[light]);
      if (!ray) continue;
      const auto id = static_cast<std::uint32_t>(job.id * frame_.scene.lights.size() + light);
      shadows_.push_back({.ray = *ray, .query = ref::Query::any, .id = id});
    }
  }

  void compare(CosimResult& counts) const {
    for (const Traced& t : traced_) {
      const ref::Hit hit =
          ref::trace<ref::RobustSlabs>(frame_.bvh, frame_.scene.mesh, t.ray, t.query, counts.reference);
      const bool same = t.query == ref::Query::any ? hit.found() == (t.triangle != ref::Hit::none)
                                                   : hit.triangle == t.triangle;
      counts.different_triangles += same ? 0 : 1;
    }
  }

  void shade(CosimResult& result) const {
    const ref::Scene& scene = frame_.scene;
    for (std::size_t pixel = 0; pixel < pixels(); ++pixel) {
      const std::size_t at = static_cast<std::size_t>(top_ + static_cast<int>(pixel) / width_) *
                                 static_cast<std::size_t>(frame_.options.width) +
                             static_cast<std::size_t>(left_ + static_cast<int>(pixel) % width_);
      const std::uint32_t triangle = triangles_[pixel];
      result.triangles[at] = triangle;
      if (triangle == ref::Hit::none) {
        result.image[at] = ref::sky(primary(pixel).direction);
        continue;
      }
      glm::vec3 light = ref::ambient(points_[pixel]);
      for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        if (!blocked_[pixel * scene.lights.size() + i]) light += ref::direct(points_[pixel], scene.lights[i]);
      }
      const std::size_t material = scene.mesh.materials.empty() ? 0 : scene.mesh.materials[triangle];
      result.image[at] = scene.materials[material].albedo * light;
    }
  }

  const Frame& frame_;
  int left_;
  int top_;
  int width_;
  int height_;
  std::size_t next_pixel_ = 0;
  std::deque<RayJob> shadows_;
  std::vector<Traced> traced_;
  std::vector<ref::SurfacePoint> points_;
  std::vector<bool> blocked_;  // by pixel and light; a light that needs no test is behind the surface
  std::vector<std::uint32_t> triangles_;
};

}  // namespace

double CosimResult::occupancy_pct() const {
  return unit.cycles == 0 ? 0.0
                          : 100.0 * static_cast<double>(unit.box_tests) / static_cast<double>(unit.cycles);
}

double CosimResult::extra_box_tests_pct() const {
  return percent_above(unit.box_tests, reference.box_tests);
}

double CosimResult::extra_triangle_tests_pct() const {
  return percent_above(unit.triangle_tests, reference.triangle_tests);
}

double CosimResult::rtl_tests_per_s() const {
  return rtl_seconds > 0 ? static_cast<double>(unit.box_tests) / rtl_seconds : 0.0;
}

bool CosimResult::verified(bool conservative) const {
  return unit.rtl_mismatches == 0 && different_triangles == 0 && (!conservative || unit.false_misses == 0);
}

CosimResult cosimulate(const rtl::Design& design, rtl::Format format, const VerilatedDesign& verilated,
                       const ref::Scene& scene, const ref::Bvh& bvh, const CosimOptions& options) {
  const std::unique_ptr<SceneFeed> feed = make_feed(design, format, bvh);
  const Frame frame{design, format, verilated, scene, bvh, options, *feed};
  CosimResult result;
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  result.image.resize(pixels);
  result.triangles.resize(pixels);
  const int columns = (options.width + tile_side - 1) / tile_side;
  const int rows = (options.height + tile_side - 1) / tile_side;
  std::vector<CosimResult> parts(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  std::atomic<std::size_t> finished = 0;

  // More workers than cores would only make TBB complain.
  tbb::task_arena arena(std::min(options.threads, tbb::info::default_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(std::size_t{0}, parts.size(), [&](std::size_t i) {
      const int column = static_cast<int>(i) % columns;
      const int row = static_cast<int>(i) / columns;
      parts[i] = Tile(frame, column * tile_side, row * tile_side).run(result);
      options.progress(static_cast<double>(++finished) / static_cast<double>(parts.size()));
    });
  });
  for (const CosimResult& part : parts) {
    result.rays_primary += part.rays_primary;
    result.rays_shadow += part.rays_shadow;
    result.rejected += part.rejected;
    result.different_triangles += part.different_triangles;
    result.unit += part.unit;
    result.reference += part.reference;
    result.rtl_seconds += part.rtl_seconds;
  }
  result.latency = verilated.latency();
  return result;
}

}  // namespace hitpipe::sim
