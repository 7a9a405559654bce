#include "sim/core/picture_rays.hpp"

#include "rays/scene/triangle_numbers.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_triangle.hpp"
#include "sw_ref/render/int_surfaces.hpp"

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

/// Answers what a core answered, in the order in which the rays were recorded.
class ReplayingTracer final : public ref::Tracer {
 public:
  ReplayingTracer(const ref::IntScene& scene, std::span<const CoreAnswer> answers)
      : numbers_(scene.mesh.mesh), answers_(answers) {}

  void trace(const ref::TraceJob& job, ref::TraceCounts& counts) const override {
    for (std::uint32_t& triangle : job.triangles) {
      const CoreAnswer answer = next_ < answers_.size() ? answers_[next_++] : CoreAnswer{};
      triangle = answer.hit.found() ? numbers_.in_mesh(answer.hit.triangle) : ref::IntHit::none;
    }
    counts.rays += job.rays.size();
  }
  [[nodiscard]] std::size_t bytes_per_node() const override { return 0; }
  [[nodiscard]] std::size_t node_count() const override { return 0; }

 private:
  ref::TriangleNumbers numbers_;
  std::span<const CoreAnswer> answers_;
  mutable std::size_t next_ = 0;
};

/// Whether T, and the weights if there are any, are those of the triangle that the answer names. Without a hit
/// T is the ray's length. Of a ray for any hit T is not promised.
bool has_its_numbers(const ref::IntScene& scene, const ref::TriangleNumbers& numbers, const CoreJob& job,
                     const CoreAnswer& answer) {
  const ref::IntRay ray = ref::int_ray(job.ray, scene.bits);
  if (!answer.hit.found()) return job.any || answer.hit.t == ray.length;
  const std::uint32_t triangle = numbers.in_mesh(answer.hit.triangle);
  if (triangle == ref::TriangleNumbers::none) return false;
  const auto crossing = ref::int_crossing(ray, scene.mesh.triangles[triangle], scene.bits);
  if (!crossing || (!job.any && answer.hit.t != crossing->t)) return false;
  if (!answer.weights) return true;
  const auto size = [&](ref::Int128 x, int shift) { return (x < 0 ? -x : x) << shift; };
  const int g = scene.bits.finer;
  return size(answer.weights->det, 2 * g) == crossing->det && size(answer.weights->u, g) == crossing->e[1] &&
         size(answer.weights->v, g) == crossing->e[2];
}

}  // namespace

std::uint64_t PictureRays::wrong(std::span<const CoreAnswer> answers) const {
  const ref::TriangleNumbers numbers(scene_->mesh.mesh);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < jobs.size(); ++i) {
    const ref::Query query = jobs[i].any ? ref::Query::any : ref::Query::closest;
    const bool same = ref::same_answer(query, answers[i].hit.triangle, triangles[i]);
    if (!same || answers[i].failed || !has_its_numbers(*scene_, numbers, jobs[i], answers[i])) ++count;
  }
  return count;
}

std::vector<glm::vec3> PictureRays::drawn(std::span<const CoreAnswer> answers,
                                          ref::RenderOptions render) const {
  const ReplayingTracer tracer(*scene_, answers);
  const ref::IntSurfaces surfaces(*scene_);
  render.surfaces = &surfaces;
  render.threads = 1;
  return ref::render(scene_->scene, tracer, render).image;
}

PictureRays picture_rays(const std::shared_ptr<const ref::IntScene>& scene, const ref::CoreImage& image,
                         const ref::CoreTracerOptions& options, ref::RenderOptions render) {
  PictureRays kept(scene);
  const RecordingTracer tracer(*scene, image, options, kept);
  const ref::IntSurfaces surfaces(*scene);
  render.surfaces = &surfaces;
  render.threads = 1;
  const ref::RenderResult rendered = ref::render(scene->scene, tracer, render);
  kept.work = rendered.counts.total();
  kept.restarts = tracer.restarts();
  return kept;
}

PictureRays listed_rays(const std::shared_ptr<const ref::IntScene>& scene, const ref::CoreImage& image,
                        const ref::CoreTracerOptions& options, std::span<const AskedRay> rays) {
  PictureRays kept(scene);
  const RecordingTracer tracer(*scene, image, options, kept);
  for (const AskedRay& asked : rays) {
    std::uint32_t triangle = 0;
    tracer.trace({{&asked.ray, 1}, asked.query, {&triangle, 1}}, kept.work);
  }
  kept.restarts = tracer.restarts();
  return kept;
}

}  // namespace hitpipe::sim
