#include "rays/trace/mesh_crossings.hpp"

#include <algorithm>

#include "rays/trace/int_box_tests.hpp"
#include "rays/world/int_boxes.hpp"

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
    : mesh_(&mesh), bvh_(bvh), options_(options), crossing_(options.world) {
  check_world(mesh, options);
  if (bvh == nullptr) return;
  if (options.boxes) {
    boxes_ = int_boxes(mesh, *bvh);
  } else {
    exact_ = std::make_shared<IntFastScene>(mesh, *bvh, options.world, width);
  }
}

/// meets(number, triangle) is the T beyond which nothing is of interest any more; nothing: it is what it was.
template <class Meets>
void MeshCrossings::walk(const IntRay& ray, const Meets& meets) const {
  if (exact_) {
    exact_->walk(ray, [&](std::uint32_t number, const IntTriangle& triangle) -> IntInterest {
      return {.up_to = meets(number, triangle)};
    });
  } else if (bvh_ != nullptr) {
    IntBoxWalk walk(*bvh_, IntWorld(*bvh_, ray), Query::closest);
    walk_boxes(walk, MajorBoxes(ray, options_), boxes_,
               [&](std::uint32_t number) { return meets(number, mesh_->triangles[number]); });
  }
}

/// Every hit, in any order.
template <class Visit>
void MeshCrossings::visit_all(const IntRay& ray, const Visit& visit) const {
  walk(ray, [&](std::uint32_t number, const IntTriangle& triangle) -> std::optional<std::int64_t> {
    if (const auto found = crossing_.crossing(ray, triangle)) visit(number, *found);
    return std::nullopt;
  });
}

CrossingCount MeshCrossings::count(const IntRay& ray) const {
  CrossingCount sum;
  visit_all(ray, [&](std::uint32_t /*triangle*/, const Crossing& crossing) { add(crossing, sum); });
  return sum;
}

std::optional<MeshCrossing> MeshCrossings::next(const IntRay& ray, const CrossingPlace& behind) const {
  std::optional<MeshCrossing> best;
  walk(ray, [&](std::uint32_t number, const IntTriangle& triangle) -> std::optional<std::int64_t> {
    const auto crossing = crossing_.crossing(ray, triangle);
    if (!crossing || !crossing->once) return std::nullopt;
    const CrossingPlace place{crossing->t, number};
    if (place <= behind || (best && best->place < place)) return std::nullopt;
    best = {place, crossing->side};
    return crossing->t;
  });
  return best;
}

CrossingList MeshCrossings::all(const IntRay& ray) const {
  CrossingList found;
  visit_all(ray, [&](std::uint32_t triangle, const Crossing& crossing) {
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
    ray.direction[static_cast<std::size_t>(axis)] = options_.world.one();
    const CrossingCount near = count(ray);
    if (near.crossings > 0 || near.ties > 0) return std::nullopt;
  }
  ray.length = options_.world.largest_distance();
  return count(ray).inside();
}

}  // namespace hitpipe::ref
