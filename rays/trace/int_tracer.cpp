#include "rays/trace/int_tracer.hpp"

#include <optional>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "rays/trace/int_box_tests.hpp"
#include "rays/trace/leaf.hpp"
#include "rays/world/int_boxes.hpp"

namespace hitpipe::ref {

namespace {

template <class Boxes>
class IntTracer final : public Tracer {
 public:
  IntTracer(const IntMesh& mesh, const Bvh* bvh, const IntTracerOptions& options)
      : mesh_(&mesh), bvh_(bvh), options_(options) {
    if (bvh != nullptr) boxes_ = int_boxes(mesh.triangles, *bvh);
  }

  void trace(const TraceJob& job, TraceCounts& counts) const override {
    check_places(job);
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      TraceCounts work{.rays = 1};
      const IntRay ray = int_ray(job.rays[i], options_.world);
      job.triangles[i] = bvh_ == nullptr ? IntHit::none : trace_one(ray, job.query, work);
      if (!job.work.empty()) job.work[i] = work;
      counts += work;
    }
  }
  [[nodiscard]] std::size_t bytes_per_node() const override {
    return sizeof(IntBox) + 2 * sizeof(std::int32_t);
  }
  [[nodiscard]] std::size_t node_count() const override { return boxes_.size(); }

 private:
  std::uint32_t trace_one(const IntRay& ray, Query query, TraceCounts& work) const {
    IntBoxWalk walk(*bvh_, IntWorld(*bvh_, ray), query);
    walk_boxes(walk, Boxes(ray, options_), boxes_,
               [&](std::uint32_t triangle) -> std::optional<std::int64_t> {
                 const auto crossing = int_crossing(ray, mesh_->triangles[triangle], options_.world);
                 return crossing ? std::optional(crossing->t) : std::nullopt;
               });
    work = walk.counts();
    return walk.hit().triangle;
  }

  const IntMesh* mesh_;
  const Bvh* bvh_;
  IntTracerOptions options_;
  std::vector<IntBox> boxes_;
};

}  // namespace

void check_world(const IntMesh& mesh, const IntTracerOptions& options) {
  const hls::WorldBits& world = options.world;
  if (!world.proved() || mesh.coord_bits != world.coord)
    throw std::invalid_argument(
        fmt::format("rays of {}+{}s{}t{} in a mesh of {} bits: there is no such world", world.coord,
                    world.finer, world.slope, world.fraction, mesh.coord_bits));
  if (options.boxes) check_box_format(world, *options.boxes);
}

void check_box_format(const hls::WorldBits& world, const hls::MajorBits& bits) {
  if (!bits.proved() || bits.coord != world.coord || bits.finer != world.finer || bits.slope != world.slope ||
      bits.fraction > world.finer + world.fraction)
    throw std::invalid_argument(fmt::format(
        "boxes of {}+{}/{}f{}s{} for rays of {}+{}s{}t{}: n, g and S must be equal, and f at most g + t",
        bits.coord, bits.finer, bits.mantissa, bits.fraction, bits.slope, world.coord, world.finer,
        world.slope, world.fraction));
}

std::unique_ptr<Tracer> int_tracer(const IntMesh& mesh, const Bvh* bvh, const IntTracerOptions& options) {
  check_world(mesh, options);
  if (options.boxes) return std::make_unique<IntTracer<MajorBoxes>>(mesh, bvh, options);
  return std::make_unique<IntTracer<ExactBoxes>>(mesh, bvh, options);
}

}  // namespace hitpipe::ref
