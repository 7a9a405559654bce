// Where a ray crosses a mesh of the integer world, each surface exactly once (rays/world/crossing.hpp): how
// often, where next, and all. Of a closed mesh the count of a ray without an end says whether its origin is
// inside.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "rays/trace/crossing_count.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rays/trace/int_triangles.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/crossing.hpp"
#include "rays/world/instances.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/quick_crossing.hpp"

namespace hitpipe::ref {

/// The order of a ray's crossings: by T, which is rounded down, and of equal T by triangle. No two are equal.
struct CrossingPlace {
  std::int64_t t = -1;         ///< in the unit of IntRay::length
  std::uint32_t triangle = 0;  ///< its number in the mesh

  friend auto operator<=>(const CrossingPlace&, const CrossingPlace&) = default;
};

struct MeshCrossing {
  CrossingPlace place;
  int side = 0;  ///< Crossing::side, 1 or -1

  friend bool operator==(const MeshCrossing&, const MeshCrossing&) = default;
};

struct CrossingList {
  std::vector<MeshCrossing> crossings;  ///< in order
  CrossingCount count;                  ///< of them
};

/// All questions are about crossings with T of 0 up to the ray's length. Answers depend neither on the
/// hierarchy nor on the format of boxes. With a mask, the ray does not see instances that have no bit of it.
/// Thread-safe.
class MeshCrossings {
 public:
  /// As int_triangles(), which says what must outlive it and what it throws.
  MeshCrossings(const IntMesh& mesh, const Bvh* bvh, const IntTracerOptions& options,
                VectorWidth width = VectorWidth::best);
  MeshCrossings(const IntInstances& world, const IntTracerOptions& options,
                VectorWidth width = VectorWidth::best);
  MeshCrossings(std::shared_ptr<const IntTriangles> triangles, const hls::WorldBits& bits)
      : bits_(bits), crossing_(bits), triangles_(std::move(triangles)) {}

  /// Of closed triangles: the least T, and of equal ones the lowest number.
  [[nodiscard]] IntHit nearest(const IntRay& ray, std::uint8_t mask = IntInstance::all_masks) const;
  [[nodiscard]] bool any(const IntRay& ray, std::uint8_t mask = IntInstance::all_masks) const;
  [[nodiscard]] CrossingCount count(const IntRay& ray, std::uint8_t mask = IntInstance::all_masks) const;
  /// The first crossing behind this place; nothing when there is none. Without a place it is the first of all.
  [[nodiscard]] std::optional<MeshCrossing> next(const IntRay& ray, const CrossingPlace& behind = {},
                                                 std::uint8_t mask = IntInstance::all_masks) const;
  [[nodiscard]] CrossingList all(const IntRay& ray, std::uint8_t mask = IntInstance::all_masks) const;
  /// What they go over.
  [[nodiscard]] const IntTriangles& triangles() const { return *triangles_; }
  /// Of a closed mesh: whether this place, in units of the origin's grid, is inside. Nothing: it is on the mesh, or
  /// less than one of these units from it along an axis.
  [[nodiscard]] std::optional<bool> is_inside(const std::array<std::int64_t, 3>& place) const;

 private:
  template <class Visit>
  void visit_all(const IntRay& ray, std::uint8_t mask, const Visit& visit) const;

  hls::WorldBits bits_;
  QuickCrossing crossing_;
  std::shared_ptr<const IntTriangles> triangles_;
};

}  // namespace hitpipe::ref
