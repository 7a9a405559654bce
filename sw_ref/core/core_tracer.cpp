#include "sw_ref/core/core_tracer.hpp"

#include <stdexcept>

#include "rays/trace/int_tracer.hpp"
#include "rays/trace/leaf.hpp"
#include "rays/world/int_triangle.hpp"
#include "sw_ref/trace/int_major_pair.hpp"
#include "sw_ref/trace/trail_walk.hpp"

namespace hitpipe::ref {

namespace {

struct Walked {
  IntHit hit;
  TrailWalk::Counts counts;
  std::uint64_t triangles = 0;
};

Walked walked(const CoreImage& image, const CoreTracerOptions& options, const IntRay& ray, Query query,
              LoadObserver* loads) {
  const auto block = [&](std::uint32_t place) -> const CoreBlock& {
    if (loads != nullptr) loads->node_loaded(place);
    return image.blocks[place];
  };
  const auto in_box = [&](std::int64_t t) { return in_box_units(t, options.world, options.boxes); };
  const MajorDistances distances(major_ray(ray, options.boxes), options.boxes);
  Walked made{};
  TrailWalk walk({PairChild::branch, 0}, in_box(ray.length), options.places);
  while (!walk.done()) {
    if (!walk.at_leaf()) {
      const CoreRecord record = record_of(block(walk.at().first));
      walk.answer(test_pair(distances, record.boxes, walk.interval()), {record.child(0), record.child(1)});
      continue;
    }
    for (std::int32_t i = 0; i < walk.at().count; ++i) {
      const CoreTriangle triangle = triangle_of(block(walk.at().first + static_cast<std::uint32_t>(i)));
      ++made.triangles;
      const auto crossing = int_crossing(ray, triangle.triangle, options.world);
      if (crossing && keep_better(crossing->t, triangle.number, made.hit) && query == Query::any) {
        made.counts = walk.counts();
        return made;
      }
    }
    walk.leaf_done(in_box(made.hit.found() ? made.hit.t : ray.length));
  }
  made.counts = walk.counts();
  return made;
}

}  // namespace

CoreTracer::CoreTracer(const CoreImage& image, const Mesh& mesh, const CoreTracerOptions& options)
    : image_(image), numbers_(mesh), options_(options) {
  check_box_format(options.world, options.boxes);
  if (options.places < 0) throw std::invalid_argument("a stack has 0 places or more");
}

void CoreTracer::trace(const TraceJob& job, TraceCounts& counts) const {
  check_places(job);
  for (std::size_t i = 0; i < job.rays.size(); ++i) {
    const Walked made = walked(image_, options_, int_ray(job.rays[i], options_.world), job.query, job.loads);
    job.triangles[i] = made.hit.found() ? numbers_.in_mesh(made.hit.triangle) : IntHit::none;
    const TraceCounts work{1, 2 * made.counts.records, made.triangles, made.counts.records, made.triangles};
    if (!job.work.empty()) job.work[i] = work;
    counts += work;
    restarts_ += made.counts.restarts;
  }
}

}  // namespace hitpipe::ref
