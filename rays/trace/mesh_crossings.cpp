#include "rays/trace/mesh_crossings.hpp"

#include <algorithm>

namespace hitpipe::ref {

namespace {

void add(const Crossing& crossing, CrossingCount& sum) {
  sum.ties += crossing.tie ? 1 : 0;
  if (!crossing.once) return;
  ++sum.crossings;
  sum.sides += crossing.side;
}

}  // namespace

MeshCrossings::MeshCrossings(const IntMesh& mesh, const Bvh* bvh, const IntTracerOptions& options,
                             VectorWidth width)
    : MeshCrossings(int_triangles(mesh, bvh, options, width), options.world) {}

MeshCrossings::MeshCrossings(const IntInstances& world, const IntTracerOptions& options, VectorWidth width)
    : MeshCrossings(int_triangles(world, options, width), options.world) {}

/// Every hit, in any order.
template <class Visit>
void MeshCrossings::visit_all(const IntRay& ray, std::uint8_t mask, const Visit& visit) const {
  triangles_->each(ray, mask, [&](std::uint32_t number, const IntTriangle& triangle) -> IntInterest {
    if (const auto found = crossing_.crossing(ray, triangle)) visit(number, *found);
    return {};
  });
}

IntHit MeshCrossings::nearest(const IntRay& ray, std::uint8_t mask) const {
  IntHit best;
  triangles_->each(ray, mask, [&](std::uint32_t number, const IntTriangle& triangle) -> IntInterest {
    const auto t = crossing_.distance(ray, triangle);
    if (!t || !keep_better(*t, number, best)) return {};
    return {.up_to = t};
  });
  return best;
}

bool MeshCrossings::any(const IntRay& ray, std::uint8_t mask) const {
  bool met = false;
  triangles_->each(ray, mask, [&](std::uint32_t /*number*/, const IntTriangle& triangle) -> IntInterest {
    met = crossing_.distance(ray, triangle).has_value();
    return {.stop = met};
  });
  return met;
}

CrossingCount MeshCrossings::count(const IntRay& ray, std::uint8_t mask) const {
  CrossingCount sum;
  visit_all(ray, mask, [&](std::uint32_t /*triangle*/, const Crossing& crossing) { add(crossing, sum); });
  return sum;
}

std::optional<MeshCrossing> MeshCrossings::next(const IntRay& ray, const CrossingPlace& behind,
                                                std::uint8_t mask) const {
  std::optional<MeshCrossing> best;
  triangles_->each(ray, mask, [&](std::uint32_t number, const IntTriangle& triangle) -> IntInterest {
    const auto crossing = crossing_.crossing(ray, triangle);
    if (!crossing || !crossing->once) return {};
    const CrossingPlace place{crossing->t, number};
    if (place <= behind || (best && best->place < place)) return {};
    best = {place, crossing->side};
    return {.up_to = crossing->t};
  });
  return best;
}

CrossingList MeshCrossings::all(const IntRay& ray, std::uint8_t mask) const {
  CrossingList found;
  visit_all(ray, mask, [&](std::uint32_t triangle, const Crossing& crossing) {
    add(crossing, found.count);
    if (crossing.once) found.crossings.push_back({{crossing.t, triangle}, crossing.side});
  });
  std::sort(found.crossings.begin(), found.crossings.end(),
            [](const MeshCrossing& a, const MeshCrossing& b) { return a.place < b.place; });
  return found;
}

std::optional<bool> MeshCrossings::is_inside(const std::array<std::int64_t, 3>& place) const {
  IntRay ray{.origin = place};
  // No triangle is parallel to all axes, so a short ray along one of them hits what the place is on.
  for (const int axis : {2, 1, 0}) {
    ray.major = axis;
    ray.direction = {};
    ray.direction[static_cast<std::size_t>(axis)] = bits_.one();
    const CrossingCount near = count(ray);
    if (near.crossings > 0 || near.ties > 0) return std::nullopt;
  }
  ray.length = bits_.largest_distance();
  return count(ray).inside();
}

}  // namespace hitpipe::ref
