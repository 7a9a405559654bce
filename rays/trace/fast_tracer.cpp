#include "rays/trace/fast_tracer.hpp"

#include "rays/trace/fast_scene.hpp"
#include "rays/trace/float_sinks.hpp"
#include "rays/trace/leaf.hpp"

namespace hitpipe::ref {

namespace {

class FastTracer final : public Tracer {
 public:
  FastTracer(const Mesh& mesh, const Bvh& bvh, VectorWidth width)
      : mesh_(mesh),
        scene_(fast_scene(
            bvh, [&](std::uint32_t triangle) { return mesh.corners(triangle); }, width)) {}

  void trace(const TraceJob& job, TraceCounts& counts) const override {
    check_places(job);
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      FastWork work;
      HitSink sink(mesh_, job.rays[i], job.query == Query::any);
      scene_->walk(job.rays[i], scene_->largest_reach(job.rays[i]), sink, work);
      job.triangles[i] = sink.hit().triangle;
      const TraceCounts of_ray{1, work.boxes, work.triangles, work.nodes, work.triangles};
      if (!job.work.empty()) job.work[i] = of_ray;
      counts += of_ray;
    }
  }

  [[nodiscard]] std::size_t bytes_per_node() const override { return scene_->bytes_per_node(); }
  [[nodiscard]] std::size_t node_count() const override { return scene_->node_count(); }

 private:
  const Mesh& mesh_;
  std::unique_ptr<FastScene> scene_;
};

}  // namespace

std::unique_ptr<Tracer> fast_tracer(const Mesh& mesh, const Bvh& bvh, VectorWidth width) {
  return std::make_unique<FastTracer>(mesh, bvh, width);
}

}  // namespace hitpipe::ref
