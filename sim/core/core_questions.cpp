#include "sim/core/core_questions.hpp"

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "rays/scene/triangle_numbers.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rays/trace/mesh_crossings.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_triangle.hpp"
#include "rtl_gen/graph/word.hpp"

namespace hitpipe::sim {

namespace {

/// A ray on its way through its crossings.
struct Walker {
  std::size_t ray = 0;
  std::size_t passed = 0;  ///< crossings
  std::int64_t t = 0;      ///< of the last one, and the number behind its triangle's
  std::uint32_t number = 0;
};

class Asking {
 public:
  Asking(CoreBench& bench, const ref::IntScene& scene, std::span<const ref::Ray> rays)
      : bench_(bench),
        scene_(scene),
        rays_(rays),
        exact_(scene.mesh, scene.hierarchy(), {.world = scene.bits}),
        numbers_(scene.mesh.mesh) {
    trace.rays = rays.size();
  }

  void count(const QuestionOptions& options);
  void nearest_and_any();
  void walk();

  QuestionTrace trace;

 private:
  [[nodiscard]] std::vector<CoreAnswer> answers_to(std::span<const CoreJob> jobs,
                                                   const std::function<void(double)>& progress = {}) {
    std::vector<CoreAnswer> answers(jobs.size());
    bench_.run(jobs, answers, progress);
    return answers;
  }
  void judge(bool right) { trace.wrong += right ? 0 : 1; }
  [[nodiscard]] std::uint32_t number_of(std::uint32_t triangle) const {
    return triangle == ref::IntHit::none ? triangle : numbers_.of_source(triangle);
  }

  CoreBench& bench_;
  const ref::IntScene& scene_;
  std::span<const ref::Ray> rays_;
  ref::MeshCrossings exact_;
  ref::TriangleNumbers numbers_;
  std::vector<std::vector<ref::MeshCrossing>> crossings_;  ///< by ray, if it walks
};

void Asking::count(const QuestionOptions& options) {
  std::vector<CoreJob> jobs;
  for (const ref::Ray& ray : rays_) jobs.push_back({.ray = ray, .any = true, .once = true});
  const std::vector<CoreAnswer> answers = answers_to(jobs, options.progress);
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const ref::IntRay ray = ref::int_ray(rays_[i], scene_.bits);
    ref::CrossingCount count;
    if (options.count_alone) {
      count = exact_.count(ray);
    } else {
      ref::CrossingList all = exact_.all(ray);
      count = all.count;
      crossings_.push_back(std::move(all.crossings));
    }
    trace.crossings += count.crossings;
    trace.ties += count.ties;
    ++trace.counts;
    const ref::IntHit& hit = answers[i].hit;
    const auto sides =
        static_cast<std::int64_t>(rtl::number_of(static_cast<rtl::Word>(hit.t), bench_.answer_bits()));
    judge(!answers[i].failed && hit.triangle == count.crossings && sides == count.sides);
    if (!options.closed || !rays_[i].is_infinite() || exact_.is_inside(ray.origin).value_or(true)) continue;
    ++trace.outside;
    trace.odd += hit.triangle % 2;
  }
}

void Asking::nearest_and_any() {
  const std::unique_ptr<ref::Tracer> tracer =
      ref::int_tracer(scene_.mesh, scene_.hierarchy(), {.world = scene_.bits});
  std::vector<std::uint32_t> wanted(rays_.size());
  ref::TraceCounts work;
  tracer->trace({.rays = rays_, .query = ref::Query::closest, .triangles = wanted}, work);
  std::vector<CoreJob> jobs;
  for (const ref::Ray& ray : rays_)
    for (const bool any : {false, true}) jobs.push_back({.ray = ray, .any = any});
  const std::vector<CoreAnswer> answers = answers_to(jobs);
  for (std::size_t i = 0; i < rays_.size(); ++i) {
    const ref::IntRay ray = ref::int_ray(rays_[i], scene_.bits);
    const bool hits = wanted[i] != ref::IntHit::none;
    const std::int64_t t =
        hits ? ref::int_crossing(ray, scene_.mesh.triangles[wanted[i]], scene_.bits)->t : ray.length;
    const CoreAnswer &nearest = answers[2 * i], &any = answers[2 * i + 1];
    judge(!nearest.failed && nearest.hit.triangle == number_of(wanted[i]) && nearest.hit.t == t);
    judge(!any.failed && any.hit.found() == hits);
    ++trace.nearests;
    ++trace.anys;
  }
}

void Asking::walk() {
  std::vector<Walker> walkers;
  for (std::size_t i = 0; i < rays_.size(); ++i) walkers.push_back({.ray = i});
  while (!walkers.empty()) {
    std::vector<CoreJob> jobs;
    for (const Walker& each : walkers)
      jobs.push_back({.ray = rays_[each.ray], .once = true, .from_t = each.t, .from_number = each.number});
    const std::vector<CoreAnswer> answers = answers_to(jobs);
    std::vector<Walker> further;
    for (std::size_t i = 0; i < walkers.size(); ++i) {
      const Walker& now = walkers[i];
      const ref::IntHit& hit = answers[i].hit;
      const std::vector<ref::MeshCrossing>& crossings = crossings_[now.ray];
      const bool ends = now.passed == crossings.size();
      const std::int64_t t =
          ends ? ref::int_ray(rays_[now.ray], scene_.bits).length : crossings[now.passed].place.t;
      const std::uint32_t number = number_of(ends ? ref::IntHit::none : crossings[now.passed].place.triangle);
      const bool right = !answers[i].failed && hit.t == t && hit.triangle == number;
      ++trace.nexts;
      judge(right);
      if (right && !ends) further.push_back({now.ray, now.passed + 1, t, number + 1});
    }
    walkers = std::move(further);
  }
}

}  // namespace

QuestionTrace& QuestionTrace::operator+=(const QuestionTrace& later) {
  rays += later.rays;
  crossings += later.crossings;
  ties += later.ties;
  nearests += later.nearests;
  anys += later.anys;
  counts += later.counts;
  nexts += later.nexts;
  wrong += later.wrong;
  outside += later.outside;
  odd += later.odd;
  return *this;
}

QuestionTrace trace_questions(CoreBench& bench, const ref::IntScene& scene, std::span<const ref::Ray> rays,
                              const QuestionOptions& options) {
  Asking asking(bench, scene, rays);
  asking.count(options);
  if (!options.count_alone) {
    asking.nearest_and_any();
    asking.walk();
  }
  return asking.trace;
}

}  // namespace hitpipe::sim
