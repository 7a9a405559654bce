#include <utility>

#include "rays/exact/floor_quotient.hpp"
#include "rays/trace/mesh_crossings.hpp"
#include "rays/trace/ray_queries.hpp"
#include "rays/world/int_mesh.hpp"

namespace hitpipe::ref {

namespace {

class IntQueries final : public RayQueries {
 public:
  IntQueries(const hls::WorldBits& bits, MeshCrossings crossings)
      : bits_(bits), crossings_(std::move(crossings)) {}

  [[nodiscard]] NearestHit nearest(const Ray& ray, HitDetail detail, std::uint8_t mask) const override {
    const IntRay rounded = int_ray(ray, bits_);
    const IntHit best = crossings_.nearest(rounded, mask);
    NearestHit found{.triangle = best.triangle};
    if (!best.found() || detail == HitDetail::triangle) return found;
    found.t = t_of_distance(best.t, ray, bits_);
    if (detail == HitDetail::distance) return found;
    const IntCrossing hit = *int_crossing(rounded, crossings_.triangles().triangle(best.triangle), bits_);
    for (std::size_t i = 0; i < 3; ++i)
      found.weights[i] = floor_quotient(static_cast<Uint128>(hit.e[i]), static_cast<Uint128>(hit.det));
    return found;
  }

  [[nodiscard]] bool any(const Ray& ray, std::uint8_t mask) const override {
    return crossings_.any(int_ray(ray, bits_), mask);
  }

  [[nodiscard]] CrossingCount count(const Ray& ray, std::uint8_t mask) const override {
    return crossings_.count(int_ray(ray, bits_), mask);
  }

  void all(const Ray& ray, std::vector<RayCrossing>& to, std::uint8_t mask) const override {
    for (const auto& [place, side] : crossings_.all(int_ray(ray, bits_), mask).crossings)
      to.push_back({place.triangle, t_of_distance(place.t, ray, bits_), side});
  }

 private:
  hls::WorldBits bits_;
  MeshCrossings crossings_;
};

}  // namespace

std::unique_ptr<RayQueries> int_queries(const IntMesh& mesh, const Bvh* bvh, const hls::WorldBits& bits,
                                        VectorWidth width) {
  return std::make_unique<IntQueries>(bits, MeshCrossings(mesh, bvh, {.world = bits}, width));
}

std::unique_ptr<RayQueries> int_queries(std::shared_ptr<const IntTriangles> triangles,
                                        const hls::WorldBits& bits) {
  return std::make_unique<IntQueries>(bits, MeshCrossings(std::move(triangles), bits));
}

}  // namespace hitpipe::ref
