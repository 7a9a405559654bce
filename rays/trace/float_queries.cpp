#include <algorithm>

#include "rays/trace/fast_scene.hpp"
#include "rays/trace/float_sinks.hpp"
#include "rays/trace/ray_queries.hpp"

namespace hitpipe::ref {

namespace {

class FloatQueries final : public RayQueries {
 public:
  FloatQueries(const Mesh& mesh, const Bvh& bvh, VectorWidth width)
      : mesh_(mesh),
        scene_(fast_scene(
            bvh, [&](std::uint32_t triangle) { return mesh.corners(triangle); }, width)) {}

  [[nodiscard]] NearestHit nearest(const Ray& ray, HitDetail detail, std::uint8_t /*mask*/) const override {
    HitSink sink(mesh_, ray, false);
    walk(ray, sink);
    NearestHit found{.triangle = sink.hit().triangle};
    if (!sink.hit().found() || detail == HitDetail::triangle) return found;
    // A hit triangle is not parallel to the ray.
    if (detail == HitDetail::distance) {
      found.t = *plane_distance(mesh_.corners(found.triangle), ray);
    } else {
      const PlanePoint point = *plane_point(mesh_.corners(found.triangle), ray);
      found.t = point.t;
      found.weights = point.weights;
    }
    return found;
  }

  [[nodiscard]] bool any(const Ray& ray, std::uint8_t /*mask*/) const override {
    HitSink sink(mesh_, ray, true);
    walk(ray, sink);
    return sink.hit().found();
  }

  [[nodiscard]] CrossingCount count(const Ray& ray, std::uint8_t /*mask*/) const override {
    CrossingCount sum;
    visit_all(ray, [&](std::uint32_t /*triangle*/, const FloatCrossing& crossing) {
      sum.ties += crossing.tie ? 1 : 0;
      if (!crossing.once) return;
      ++sum.crossings;
      sum.sides += crossing.side;
    });
    return sum;
  }

  void all(const Ray& ray, std::vector<RayCrossing>& to, std::uint8_t /*mask*/) const override {
    const auto first = static_cast<std::ptrdiff_t>(to.size());
    visit_all(ray, [&](std::uint32_t triangle, const FloatCrossing& crossing) {
      if (crossing.once)
        to.push_back({triangle, *plane_distance(mesh_.corners(triangle), ray), crossing.side});
    });
    // Where the numbers differ, so do the exact ones of which they are the floors.
    std::sort(to.begin() + first, to.end(), [&](const RayCrossing& a, const RayCrossing& b) {
      return a.t != b.t ? a.t < b.t : triangle_filter::before_exactly(mesh_, a.triangle, b.triangle, ray);
    });
  }

 private:
  void walk(const Ray& ray, FastSink& sink) const {
    FastWork work;
    scene_->walk(ray, scene_->largest_reach(ray), sink, work);
  }
  template <class Visit>
  void visit_all(const Ray& ray, const Visit& visit) const {
    FloatCrossingSink sink(ray, visit);
    walk(ray, sink);
  }

  const Mesh& mesh_;
  std::unique_ptr<FastScene> scene_;
};

}  // namespace

std::unique_ptr<RayQueries> float_queries(const Mesh& mesh, const Bvh& bvh, VectorWidth width) {
  return std::make_unique<FloatQueries>(mesh, bvh, width);
}

}  // namespace hitpipe::ref
