#include "rays/exact/floor_quotient.hpp"
#include "rays/trace/int_fast_scene.hpp"
#include "rays/trace/mesh_crossings.hpp"
#include "rays/trace/ray_queries.hpp"
#include "rays/world/int_mesh.hpp"

namespace hitpipe::ref {

namespace {

class IntQueries final : public RayQueries {
 public:
  IntQueries(const IntMesh& mesh, const Bvh* bvh, const hls::WorldBits& bits, VectorWidth width)
      : mesh_(mesh), bits_(bits), quick_(bits), crossings_(mesh, bvh, {.world = bits}, width) {}

  [[nodiscard]] NearestHit nearest(const Ray& ray, HitDetail detail) const override {
    const IntRay rounded = int_ray(ray, bits_);
    IntHit best;
    walk(rounded, [&](std::uint32_t number, const IntTriangle& triangle) -> IntInterest {
      const auto t = quick_.distance(rounded, triangle);
      if (!t || !keep_better(*t, number, best)) return {};
      return {.up_to = t};
    });
    NearestHit found{.triangle = best.triangle};
    if (!best.found() || detail == HitDetail::triangle) return found;
    found.t = t_of_distance(best.t, ray, bits_);
    if (detail == HitDetail::distance) return found;
    const IntCrossing hit = *int_crossing(rounded, mesh_.triangles[best.triangle], bits_);
    for (std::size_t i = 0; i < 3; ++i)
      found.weights[i] = floor_quotient(static_cast<Uint128>(hit.e[i]), static_cast<Uint128>(hit.det));
    return found;
  }

  [[nodiscard]] bool any(const Ray& ray) const override {
    const IntRay rounded = int_ray(ray, bits_);
    bool met = false;
    walk(rounded, [&](std::uint32_t /*number*/, const IntTriangle& triangle) -> IntInterest {
      met = quick_.distance(rounded, triangle).has_value();
      return {.stop = met};
    });
    return met;
  }

  [[nodiscard]] CrossingCount count(const Ray& ray) const override {
    return crossings_.count(int_ray(ray, bits_));
  }

  void all(const Ray& ray, std::vector<RayCrossing>& to) const override {
    for (const auto& [place, side] : crossings_.all(int_ray(ray, bits_)).crossings)
      to.push_back({place.triangle, t_of_distance(place.t, ray, bits_), side});
  }

 private:
  template <class Meets>
  void walk(const IntRay& ray, const Meets& meets) const {
    if (crossings_.exact() != nullptr) crossings_.exact()->walk(ray, meets);
  }

  const IntMesh& mesh_;
  hls::WorldBits bits_;
  QuickCrossing quick_;
  MeshCrossings crossings_;
};

}  // namespace

std::unique_ptr<RayQueries> int_queries(const IntMesh& mesh, const Bvh* bvh, const hls::WorldBits& bits,
                                        VectorWidth width) {
  return std::make_unique<IntQueries>(mesh, bvh, bits, width);
}

}  // namespace hitpipe::ref
