#include "sim/core/replay.hpp"

#include "rays/scene/triangle_numbers.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/int_triangle.hpp"
#include "sim/operands/traced_list.hpp"

namespace hitpipe::sim {

namespace {

constexpr std::string_view no_reason = "the record does not say why";
constexpr std::string_view no_such_triangle = "the image has no triangle of that number";
constexpr std::string_view not_met = "the ray does not meet its triangle";
constexpr std::string_view met_elsewhere = "its triangle has another T";

/// A distance as a fraction in lowest terms, so equal ones have equal members.
struct Distance {
  ref::Int128 above, below;

  friend bool operator==(const Distance&, const Distance&) = default;
};

/// Along the major axis, before it is rounded down to T.
Distance distance_of(const ref::IntRay& ray, const ref::IntTriangle& triangle,
                     const ref::IntCrossing& crossing, const hls::WorldBits& bits) {
  const auto m = static_cast<std::size_t>(ray.major);
  ref::Int128 above = 0;
  for (std::size_t corner = 0; corner < 3; ++corner) {
    const std::int64_t depth = (std::int64_t{triangle.corners[corner][m]} << bits.finer) - ray.origin[m];
    above += crossing.e[corner] * (ray.direction[m] < 0 ? -depth : depth);
  }
  ref::Int128 common = crossing.det, rest = above;
  while (rest != 0) {
    const ref::Int128 next = common % rest;
    common = rest;
    rest = next;
  }
  return {above / common, crossing.det / common};
}

/// A triangle that an answer names, and where the ray meets it.
struct Named {
  std::uint32_t triangle = ref::TriangleNumbers::none;  ///< in the mesh
  std::optional<ref::IntCrossing> crossing{};

  [[nodiscard]] std::string_view why_not() const {
    return triangle == ref::TriangleNumbers::none ? no_such_triangle : not_met;
  }
};

Named named(const ref::IntScene& scene, const ref::IntRay& ray, std::uint32_t number) {
  Named made{.triangle = ref::TriangleNumbers(scene.mesh.mesh).in_mesh(number)};
  if (made.triangle != ref::TriangleNumbers::none)
    made.crossing = ref::int_crossing(ray, scene.mesh.triangles[made.triangle], scene.bits);
  return made;
}

Distance distance_of(const ref::IntScene& scene, const ref::IntRay& ray, const Named& met) {
  return distance_of(ray, scene.mesh.triangles[met.triangle], met.crossing.value(), scene.bits);
}

}  // namespace

Judgement judge(const ref::IntScene& scene, const ref::IntRay& ray, ref::Query query,
                const RecordedAnswer& recorded, const RightAnswer& right) {
  if (recorded.failed != hls::not_failed) return {Verdict::failed, hls::failure_texts[recorded.failed]};
  if (!recorded.given) return {Verdict::failed, no_reason};
  if (!recorded.triangle) return {right.triangle ? Verdict::farther : Verdict::same};
  if (!right.triangle) return {Verdict::nearer};
  const Named own = named(scene, ray, *recorded.triangle);
  const Judgement impossible{Verdict::failed, own.why_not()};
  if (query == ref::Query::any) return own.crossing ? Judgement{Verdict::same} : impossible;
  if (!recorded.t && !own.crossing) return impossible;
  if (const std::int64_t t = recorded.t ? *recorded.t : own.crossing->t; t != right.t)
    return {t < right.t ? Verdict::nearer : Verdict::farther};
  if (*recorded.triangle == *right.triangle) return {Verdict::same};
  if (!own.crossing) return impossible;
  if (own.crossing->t != right.t) return {Verdict::failed, met_elsewhere};
  const bool equal =
      distance_of(scene, ray, own) == distance_of(scene, ray, named(scene, ray, *right.triangle));
  return {equal ? Verdict::exact_tie : Verdict::near_tie};
}

std::vector<RightAnswer> right_answers(const ref::IntScene& scene, std::span<const AskedRay> rays,
                                       int threads, const std::function<void(double)>& progress) {
  ref::BuildOptions build = ref::surface_area_build;
  build.padding = 0.0F;
  build.threads = threads;
  const ref::Bvh bvh = ref::build_bvh(scene.mesh.mesh, build);
  // A ray for any hit is judged by its nearest one too.
  std::vector<AskedRay> nearest(rays.begin(), rays.end());
  for (AskedRay& each : nearest) each.query = ref::Query::closest;
  const TracedList traced =
      trace_list(*ref::int_tracer(scene.mesh, &bvh, {.world = scene.bits}), nearest, threads, progress);
  const ref::TriangleNumbers numbers(scene.mesh.mesh);
  std::vector<RightAnswer> made(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const std::uint32_t triangle = traced.triangles[i];
    if (triangle == ref::IntHit::none) continue;
    const ref::IntRay ray = ref::int_ray(rays[i].ray, scene.bits);
    made[i] = {numbers.of_source(triangle),
               ref::int_crossing(ray, scene.mesh.triangles[triangle], scene.bits).value().t};
  }
  return made;
}

}  // namespace hitpipe::sim
