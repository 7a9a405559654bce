#include "sw_ref/world/int_tracer.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <fmt/format.h>

#include "sw_ref/trace/int_major.hpp"
#include "sw_ref/trace/leaf_test.hpp"
#include "sw_ref/world/int_meets.hpp"
#include "sw_ref/world/int_world.hpp"

namespace hitpipe::ref {

namespace {

class ExactBoxes {
 public:
  ExactBoxes(const IntRay& ray, const IntTracerOptions& options) : ray_(&ray), bits_(options.world) {}
  void cut(std::int64_t length) { length_ = length; }
  [[nodiscard]] bool operator()(const IntBox& box) const { return int_meets(*ray_, box, length_, bits_); }

 private:
  const IntRay* ray_;
  hls::WorldBits bits_;
  std::int64_t length_ = 0;
};

class MajorBoxes {
 public:
  MajorBoxes(const IntRay& ray, const IntTracerOptions& options)
      : world_(options.world), bits_(*options.boxes), distances_(major_ray(ray, bits_), bits_) {}
  void cut(std::int64_t length) { length_ = in_box_units(length, world_, bits_); }
  [[nodiscard]] bool operator()(const IntBox& box) const { return distances_.meets(box, length_); }

 private:
  hls::WorldBits world_;
  hls::MajorBits bits_;
  MajorDistances distances_;
  std::int64_t length_ = 0;
};

template <class Boxes>
class IntTracer final : public Tracer {
 public:
  IntTracer(const IntMesh& mesh, const Bvh* bvh, const IntTracerOptions& options)
      : mesh_(&mesh), bvh_(bvh), options_(options) {
    if (bvh != nullptr) boxes_ = int_boxes(mesh, *bvh);
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
    Boxes test(ray, options_);
    test.cut(walk.length());
    while (!walk.done()) {
      if (!walk.at_triangle()) {
        walk.answer(test(boxes_[walk.node()]));
        continue;
      }
      const auto crossing = int_crossing(ray, mesh_->triangles[walk.triangle()], options_.world);
      walk.answer_triangle(crossing.has_value(), crossing ? crossing->t : 0);
      if (crossing) test.cut(walk.length());
    }
    work = walk.counts();
    return walk.hit().triangle;
  }

  const IntMesh* mesh_;
  const Bvh* bvh_;
  IntTracerOptions options_;
  std::vector<IntBox> boxes_;
};

void check(const IntMesh& mesh, const IntTracerOptions& options) {
  const hls::WorldBits& world = options.world;
  if (!world.proved() || mesh.coord_bits != world.coord)
    throw std::invalid_argument(
        fmt::format("rays of {}+{}s{}t{} in a mesh of {} bits: there is no such world", world.coord,
                    world.finer, world.slope, world.fraction, mesh.coord_bits));
  if (options.boxes) check_box_format(world, *options.boxes);
}

}  // namespace

void check_box_format(const hls::WorldBits& world, const hls::MajorBits& bits) {
  if (!bits.proved() || bits.coord != world.coord || bits.finer != world.finer || bits.slope != world.slope ||
      bits.fraction > world.finer + world.fraction)
    throw std::invalid_argument(fmt::format(
        "boxes of {}+{}/{}f{}s{} for rays of {}+{}s{}t{}: n, g and S must be equal, and f at most g + t",
        bits.coord, bits.finer, bits.mantissa, bits.fraction, bits.slope, world.coord, world.finer,
        world.slope, world.fraction));
}

std::unique_ptr<Tracer> int_tracer(const IntMesh& mesh, const Bvh* bvh, const IntTracerOptions& options) {
  check(mesh, options);
  if (options.boxes) return std::make_unique<IntTracer<MajorBoxes>>(mesh, bvh, options);
  return std::make_unique<IntTracer<ExactBoxes>>(mesh, bvh, options);
}

}  // namespace hitpipe::ref
