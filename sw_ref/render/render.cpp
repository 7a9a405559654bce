#include "sw_ref/render/render.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <mutex>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "host/parallel.hpp"
#include "rays/exact/exact_triangle.hpp"
#include "sw_ref/render/camera.hpp"
#include "sw_ref/render/shade.hpp"

namespace hitpipe::ref {
namespace {

struct Frame {
  const Scene& scene;
  const Tracer& tracer;
  const RenderOptions& options;
  Whitted whitted;
  int columns;  // of tiles
};

/// Renders one tile after the other and reuses its buffers.
class TileRenderer {
 public:
  TileRenderer(const Frame& frame, RenderResult& result)
      : frame_(frame),
        result_(result),
        shadows_(causes().lights.size() + std::size_t{causes().occlusion}),
        secondary_(secondary_sources()),
        generation_(secondary_.size()) {}

  void run(std::size_t tile) {
    const int side = frame_.options.tile_side;
    left_ = static_cast<int>(tile) % frame_.columns * side;
    top_ = static_cast<int>(tile) / frame_.columns * side;
    width_ = std::min(side, result_.width - left_);
    const int height = std::min(side, result_.height - top_);
    light_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height), {});
    batch_.clear();
    for (std::size_t i = 0; i < light_.size(); ++i) {
      const int x = left_ + static_cast<int>(i) % width_;
      const int y = top_ + static_cast<int>(i) / width_;
      batch_.push_back(
          frame_.whitted.primary(x, y, result_.width, result_.height, static_cast<std::uint32_t>(place(i))));
    }
    note_queue(RayKind::primary, batch_.size());
    trace(batch_);
    keep_primary_hits();
    trace_shadows();
    while (waiting(secondary_) > 0) {
      std::swap(secondary_, generation_);
      for (Queue& batch : generation_) {
        trace(batch);
        note_queue(RayKind::secondary, waiting(generation_) + waiting(secondary_));
        batch.clear();
      }
      trace_shadows();
    }
    for (std::size_t i = 0; frame_.options.picture && i < light_.size(); ++i)
      result_.image[place(i)] = light_[i].value();
  }

  /// The result of all tiles so far.
  [[nodiscard]] const RenderCounts& counts() const { return counts_; }
  [[nodiscard]] const ShadingCounts& shading() const { return shading_; }

 private:
  using Queue = std::vector<RayTask>;

  [[nodiscard]] const RayCauses& causes() const { return frame_.whitted.causes(); }

  [[nodiscard]] std::size_t secondary_sources() const {
    if (causes().scattered)
      return RayTask::scattered + static_cast<std::size_t>(frame_.options.light.diffuse);
    return std::size_t{causes().mirrors} + std::size_t{causes().refracts};
  }

  void note_queue(RayKind kind, std::size_t tasks) {
    std::uint64_t& most = shading_.queue_bytes.at(static_cast<std::size_t>(kind));
    most = std::max(most, std::uint64_t{tasks * sizeof(RayTask)});
  }

  [[nodiscard]] static std::size_t waiting(const std::vector<Queue>& queues) {
    std::size_t tasks = 0;
    for (const Queue& queue : queues) tasks += queue.size();
    return tasks;
  }

  /// The index in the result of a pixel of the tile.
  [[nodiscard]] std::size_t place(std::size_t pixel) const {
    const int x = left_ + static_cast<int>(pixel) % width_;
    const int y = top_ + static_cast<int>(pixel) / width_;
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(result_.width) +
           static_cast<std::size_t>(x);
  }

  /// The other way round.
  [[nodiscard]] std::size_t in_tile(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(result_.width);
    return (pixel / width - static_cast<std::size_t>(top_)) * static_cast<std::size_t>(width_) +
           pixel % width - static_cast<std::size_t>(left_);
  }

  /// Traces tasks of one kind, and sorts the tasks that follow into shadows_ and secondary_.
  void trace(const Queue& batch) {
    if (batch.empty()) return;
    rays_.clear();
    for (const RayTask& task : batch) rays_.push_back(task.ray);
    triangles_.resize(batch.size());
    if (frame_.options.maps) work_.assign(batch.size(), {});
    const RayTask& first = batch.front();
    const TraceJob job{rays_, first.query(), triangles_, work_};
    frame_.tracer.trace(job, counts_.of(first.kind));
    if (frame_.options.traced) frame_.options.traced(first.kind, job);
    next_.clear();
    for (std::size_t i = 0; i < batch.size(); ++i) {
      const ShadeWork work =
          frame_.whitted.end(batch[i], triangles_[i], light_[in_tile(batch[i].pixel)], next_);
      shading_.surface_points += work.surface_points;
      shading_.light_evaluations += work.light_evaluations;
    }
    for (const RayTask& task : next_)
      (task.kind == RayKind::shadow ? shadows_[task.source] : secondary_[task.source]).push_back(task);
    for (std::size_t i = 0; i < work_.size(); ++i) {
      const std::size_t at = batch[i].pixel;
      result_.box_tests[at] += static_cast<float>(work_[i].box_tests);
      result_.triangle_tests[at] += static_cast<float>(work_[i].triangle_tests);
    }
  }

  void trace_shadows() {
    note_queue(RayKind::shadow, waiting(shadows_));
    for (Queue& batch : shadows_) {
      trace(batch);
      batch.clear();
    }
  }

  /// To be called directly after trace(batch_).
  void keep_primary_hits() {
    if (!frame_.options.picture) return;
    for (std::size_t i = 0; i < batch_.size(); ++i) {
      const std::uint32_t triangle = triangles_[i];
      result_.triangles[place(i)] = triangle;
      if (!frame_.options.maps || triangle == Hit::none) continue;
      const Ray& ray = batch_[i].ray;
      const Surfaces* const surfaces = frame_.options.surfaces;
      const glm::dvec3 position = surfaces == nullptr
                                      ? surface_point(frame_.scene.mesh, triangle, ray).position
                                      : surfaces->point(triangle, ray).position;
      result_.depth[place(i)] = static_cast<float>(depth_of(frame_.scene.camera, position));
    }
  }

  const Frame& frame_;
  RenderResult& result_;
  int left_ = 0;
  int top_ = 0;
  int width_ = 0;
  RenderCounts counts_;
  ShadingCounts shading_;
  std::vector<LightSum> light_;  // by pixel of the tile
  Queue batch_;
  std::vector<Queue> shadows_;     // by source of their tasks
  std::vector<Queue> secondary_;   // the same, if the scene causes them
  std::vector<Queue> generation_;  // the secondary rays that are being traced
  Queue next_;
  std::vector<Ray> rays_;
  std::vector<std::uint32_t> triangles_;
  std::vector<TraceCounts> work_;
};

int tiles(int pixels, int side) {
  return (pixels - 1) / side + 1;
}

}  // namespace

int tile_side_for(int bundle) {
  return bundle == 64 ? 8 : bundle == 256 ? 16 : 32;
}

std::uint64_t tile_count(const RenderOptions& options) {
  return static_cast<std::uint64_t>(tiles(options.width, options.tile_side)) *
         static_cast<std::uint64_t>(tiles(options.height, options.tile_side));
}

std::vector<float> extra_box_tests(const RenderResult& result, const RenderResult& reference) {
  std::vector<float> extra(result.box_tests.size());
  for (std::size_t i = 0; i < extra.size(); ++i)
    extra[i] = std::max(0.0F, result.box_tests[i] - reference.box_tests[i]);
  return extra;
}

TraceCounts& RenderCounts::of(RayKind kind) {
  return kind == RayKind::primary ? primary : kind == RayKind::secondary ? secondary : shadow;
}

TraceCounts RenderCounts::total() const {
  TraceCounts sum = primary;
  sum += secondary;
  sum += shadow;
  return sum;
}

RenderCounts& RenderCounts::operator+=(const RenderCounts& other) {
  primary += other.primary;
  secondary += other.secondary;
  shadow += other.shadow;
  return *this;
}

ShadingCounts& ShadingCounts::operator+=(const ShadingCounts& other) {
  surface_points += other.surface_points;
  light_evaluations += other.light_evaluations;
  for (std::size_t kind = 0; kind < queue_bytes.size(); ++kind)
    queue_bytes.at(kind) = std::max(queue_bytes.at(kind), other.queue_bytes.at(kind));
  return *this;
}

RenderResult render(const Scene& scene, const Tracer& tracer, const RenderOptions& options) {
  if (options.width < 1 || options.height < 1)
    throw std::invalid_argument(
        fmt::format("image of {} x {} pixels; at least 1 x 1 is needed", options.width, options.height));
  if (std::uint64_t{static_cast<unsigned>(options.width)} * static_cast<unsigned>(options.height) >
      std::numeric_limits<std::uint32_t>::max())
    throw std::invalid_argument(
        fmt::format("image of {} x {} pixels; less than 2^32 are allowed", options.width, options.height));
  if (options.threads < 1)
    throw std::invalid_argument(fmt::format("{} threads; at least 1 is needed", options.threads));
  if (options.tile_side < 1)
    throw std::invalid_argument(fmt::format("tile side {}; at least 1 is needed", options.tile_side));
  const Frame frame{scene, tracer, options, Whitted(scene, options.light, options.surfaces),
                    tiles(options.width, options.tile_side)};
  RenderResult result;
  result.width = options.width;
  result.height = options.height;
  const auto pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  if (options.picture) {
    result.image.resize(pixels);
    result.triangles.resize(pixels);
  }
  if (options.maps) {
    result.depth.assign(pixels, std::numeric_limits<float>::infinity());
    result.box_tests.resize(pixels);
    result.triangle_tests.resize(pixels);
  }
  const host::Piece::Range mine = options.tiles.range(tile_count(options));
  const std::uint64_t count = mine.size();
  std::mutex counting;
  std::atomic<std::size_t> finished = 0;
  // Tiles are small; a thousand steps of progress are enough.
  const auto steps = [&](std::size_t done) { return 1000 * done / count; };
  host::with_threads(options.threads, [&] {
    // A renderer serves several tiles, and no thread waits long for the last ones.
    const std::size_t block = std::clamp<std::size_t>(count / 256, 1, 64);
    host::for_each_block(mine.first, mine.end, block, [&](std::size_t first, std::size_t last) {
      TileRenderer renderer(frame, result);
      for (std::size_t tile = first; tile < last; ++tile) {
        renderer.run(tile);
        const std::size_t done = ++finished;
        if (steps(done) != steps(done - 1))
          options.progress(static_cast<double>(done) / static_cast<double>(count));
      }
      const std::scoped_lock lock(counting);
      result.counts += renderer.counts();
      result.shading += renderer.shading();
    });
  });
  return result;
}

}  // namespace hitpipe::ref
