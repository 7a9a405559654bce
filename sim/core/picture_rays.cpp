#include "sim/core/picture_rays.hpp"

#include <utility>

#include "sw_ref/scene/triangle_numbers.hpp"
#include "sw_ref/world/int_ray.hpp"
#include "sw_ref/world/int_tracer.hpp"
#include "sw_ref/world/int_triangle.hpp"

namespace hitpipe::sim {

namespace {

/// Keeps what it traces.
class RecordingTracer final : public ref::Tracer {
 public:
  RecordingTracer(const ref::IntScene& scene, const ref::CoreImage& image,
                  const ref::CoreTracerOptions& options, PictureRays& kept)
      : core_(image, scene.mesh.mesh, options), numbers_(scene.mesh.mesh), kept_(kept) {}

  void trace(const ref::TraceJob& job, ref::TraceCounts& counts) const override {
    core_.trace(job, counts);
    for (std::size_t i = 0; i < job.rays.size(); ++i) {
      kept_.jobs.push_back({job.rays[i], job.query == ref::Query::any});
      const std::uint32_t hit = job.triangles[i];
      kept_.triangles.push_back(hit == ref::IntHit::none ? hit : numbers_.of_source(hit));
    }
  }
  [[nodiscard]] std::size_t bytes_per_node() const override { return core_.bytes_per_node(); }
  [[nodiscard]] std::size_t node_count() const override { return core_.node_count(); }
  [[nodiscard]] std::uint64_t restarts() const { return core_.restarts(); }

 private:
  ref::CoreTracer core_;
  ref::TriangleNumbers numbers_;
  PictureRays& kept_;
};

/// Whether the answer's weights are those of the triangle that it names.
bool has_its_weights(const CoreJob& job, const CoreAnswer& answer, const ref::IntScene* of) {
  if (!answer.weights || !answer.hit.found()) return true;
  const ref::IntScene& scene = *of;
  const std::uint32_t triangle = ref::TriangleNumbers(scene.mesh.mesh).in_mesh(answer.hit.triangle);
  if (triangle == ref::TriangleNumbers::none) return false;
  const auto crossing =
      ref::int_crossing(ref::int_ray(job.ray, scene.bits), scene.mesh.triangles[triangle], scene.bits);
  const auto size = [&](ref::Int128 x, int shift) { return (x < 0 ? -x : x) << shift; };
  const int g = scene.bits.finer;
  return crossing && size(answer.weights->det, 2 * g) == crossing->det &&
         size(answer.weights->u, g) == crossing->e[1] && size(answer.weights->v, g) == crossing->e[2];
}

}  // namespace

std::uint64_t PictureRays::wrong(std::span<const CoreAnswer> answers) const {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const ref::Query query = jobs[i].any ? ref::Query::any : ref::Query::closest;
    const bool same = ref::same_answer(query, answers[i].hit.triangle, triangles[i]);
    if (!same || answers[i].failed || !has_its_weights(jobs[i], answers[i], scene)) ++count;
  }
  return count;
}

PictureRays picture_rays(const ref::IntScene& scene, const ref::CoreImage& image,
                         const ref::CoreTracerOptions& options, ref::RenderOptions render) {
  PictureRays kept;
  kept.scene = &scene;
  const RecordingTracer tracer(scene, image, options, kept);
  const ref::IntSurfaces surfaces(scene);
  render.surfaces = &surfaces;
  render.threads = 1;
  ref::RenderResult rendered = ref::render(scene.scene, tracer, render);
  kept.work = rendered.counts.total();
  kept.image = std::move(rendered.image);
  kept.restarts = tracer.restarts();
  return kept;
}

PictureRays listed_rays(const ref::IntScene& scene, const ref::CoreImage& image,
                        const ref::CoreTracerOptions& options, std::span<const AskedRay> rays) {
  PictureRays kept;
  kept.scene = &scene;
  const RecordingTracer tracer(scene, image, options, kept);
  for (const AskedRay& asked : rays) {
    std::uint32_t triangle = 0;
    tracer.trace({{&asked.ray, 1}, asked.query, {&triangle, 1}}, kept.work);
  }
  kept.restarts = tracer.restarts();
  return kept;
}

}  // namespace hitpipe::sim
