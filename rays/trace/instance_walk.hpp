// One ray's walk through instances, box by box as a core's units test them: through the hierarchy over the instances in
// the world, and from there through the meshes' in their own spaces (docs/instances.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "hls/box/major_format.hpp"
#include "rays/trace/int_box_tests.hpp"
#include "rays/trace/int_major.hpp"
#include "rays/trace/int_world.hpp"
#include "rays/world/instances.hpp"
#include "rays/world/object_space.hpp"

namespace hitpipe::ref {

/// What a walk did.
struct InstanceWork {
  std::uint64_t top_boxes = 0;
  std::uint64_t mesh_boxes = 0;
  std::uint64_t entered = 0;  ///< instances; those that a ray misses at once are none
  std::uint64_t triangles = 0;
  std::uint64_t cuts = 0;  ///< in an object, made again after a hit there
};

/// Boxes of a mesh for a ray that is in its space. The ray may be off by the instance's slack, so near planes are seen
/// from ahead and far ones from behind.
class ObjectBoxes {
 public:
  ObjectBoxes(const ObjectRay& ray, const ObjectSpace& space, const hls::MajorBits& bits)
      : ray_(&ray), bits_(bits), distances_(distances(ray, space, bits)) {}
  /// At T in the world.
  void cut(std::int64_t t) { length_ = ray_->distance(t, bits_.fraction, bits_.largest_length()); }
  [[nodiscard]] bool operator()(const IntBox& box) const { return distances_.meets(box, length_); }

 private:
  static MajorDistances distances(const ObjectRay& ray, const ObjectSpace& space,
                                  const hls::MajorBits& bits) {
    const IntMajorRay operands = ray.operands(bits);
    std::array<std::int64_t, 3> slack{};
    for (std::size_t i = 0; i < 3; ++i) slack[i] = space.slack[static_cast<std::size_t>(operands.axes[i])];
    return {operands, bits, slack};
  }

  const ObjectRay* ray_;
  hls::MajorBits bits_;
  MajorDistances distances_;
  std::int64_t length_ = 0;
};

/// Boxes of a mesh whose instance is on the lattice: they are moved, and the ray stays where it is. Nothing is rounded
/// that the corners are not, so there is no slack.
class LatticeBoxes {
 public:
  LatticeBoxes(const MajorBoxes& world, const GridMap& map) : world_(world), map_(&map) {}
  void cut(std::int64_t t) { world_.cut(t); }
  [[nodiscard]] bool operator()(const IntBox& box) const { return world_((*map_)(box)); }

 private:
  MajorBoxes world_;
  const GridMap* map_;
};

/// meets(number, triangle) for each triangle that the ray may hit, until T that it gives, that T included; nothing: as
/// before. `options` has a format of boxes. Comes to every triangle that the ray hits up to there, once. The ray does
/// not see instances whose mask has no bit of `mask`.
template <class Meets>
void walk_instances(const IntInstances& world, const IntRay& ray, std::uint8_t mask,
                    const IntTracerOptions& options, Meets& meets, InstanceWork& work) {
  if (world.top().nodes.empty()) return;
  const hls::MajorBits& boxes = *options.boxes;
  std::int64_t length = ray.length;
  const MajorBoxes in_world(ray, options);
  const auto walk_mesh = [&](const IntInstances::Entry& entry, std::array<bool, 3> negative, auto test) {
    const std::int64_t before = length;
    const std::uint32_t number = entry.instance;
    const IntObject& mesh = world.mesh_of(number);
    const std::uint32_t base = world.base(number);
    ++work.entered;
    IntBoxWalk walk(mesh.bvh(), IntWorld(mesh.bvh(), length, direction_class(negative)), Query::closest,
                    entry.node);
    walk.answer(true);  // the entry's own box has been tested in the world
    walk_boxes(walk, test, mesh.boxes(), [&](std::uint32_t k) -> std::optional<std::int64_t> {
      const auto t = meets(base + k, world.triangle(number, k));
      if (!t) return std::nullopt;
      ++work.cuts;
      length = *t;
      return t;
    });
    work.mesh_boxes += walk.counts().box_tests - 1;
    work.triangles += walk.counts().triangle_tests;
    return length == before ? std::nullopt : std::optional(length);
  };
  IntBoxWalk top(world.top(), IntWorld(world.top(), ray), Query::closest);
  walk_boxes(top, in_world, world.top_boxes(), [&](std::uint32_t at) -> std::optional<std::int64_t> {
    const IntInstances::Entry& entry = world.entries()[at];
    const IntInstance& instance = world.instances()[entry.instance];
    if ((instance.mask & mask) == 0) return std::nullopt;
    if (instance.map.is_lattice()) {
      std::array<bool, 3> negative{};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t j = 0; j < 3; ++j)
          if (instance.map.matrix[k][j] != 0)
            negative[j] = ray.negative[k] != (instance.map.matrix[k][j] < 0);
      return walk_mesh(entry, negative, LatticeBoxes(in_world, instance.map));
    }
    const auto inside = ObjectRay::enter(entry.space, instance.map, ray, length, options.world);
    if (!inside) return std::nullopt;
    std::array<bool, 3> negative{};
    for (std::size_t k = 0; k < 3; ++k) negative[k] = inside->direction()[k] < 0;
    return walk_mesh(entry, negative, ObjectBoxes(*inside, entry.space, boxes));
  });
  work.top_boxes += top.counts().box_tests;
}

}  // namespace hitpipe::ref
