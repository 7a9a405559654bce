// The fast walk in the integer world. Boxes and corners are integers in binary32, which holds them. A ray is rounded
// where binary32 does not hold it, and boxes and the filter of triangles allow for that. Integers decide what is hit.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "hls/world/world_format.hpp"
#include "rays/mesh/mesh.hpp"
#include "rays/mesh/ray.hpp"
#include "rays/trace/fast_scene.hpp"
#include "rays/trace/int_triangles.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/instances.hpp"
#include "rays/world/int_box.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::ref {

/// Rays of a world in binary32. Units are those of corners, and the direction is 1 along the major axis.
class FloatRays {
 public:
  explicit FloatRays(const hls::WorldBits& bits);

  [[nodiscard]] Ray operator()(const IntRay& ray) const;
  /// A hit at T lies below T + 1.
  [[nodiscard]] float length(std::int64_t t) const;
  /// Of boxes: they hold, seen from a rounded origin, what their own hold seen from the exact one.
  [[nodiscard]] float padding() const { return padding_; }
  /// Of the filter's reach, for rays that are rounded.
  [[nodiscard]] float allowance() const { return allowance_; }

 private:
  float origin_unit_, direction_unit_;  ///< 2^-g, 2^-S
  double length_unit_;                  ///< 2^-(g+F)
  float padding_, allowance_;
};

/// The hierarchy with these boxes in place of its own, grown by the padding.
[[nodiscard]] Bvh with_boxes(const Bvh& bvh, std::span<const IntBox> boxes, float padding);

[[nodiscard]] Mesh::Corners float_corners(const IntTriangle& triangle);

/// The triangles of packs in integers, for a visitor.
class IntSink : public FastSink {
 public:
  /// `base` is added to numbers.
  IntSink(IntVisitor& visitor, std::uint32_t base) : visitor_(visitor), base_(base) {}
  AfterLeaf meets(const TrianglePack& pack, unsigned may_hit) final;
  [[nodiscard]] bool stopped() const { return stopped_; }

 protected:
  ~IntSink() = default;
  /// Of the visitor's interest, after AfterLeaf::shorter.
  [[nodiscard]] std::int64_t up_to() const { return up_to_; }

 private:
  IntVisitor& visitor_;
  std::uint32_t base_;
  std::int64_t up_to_ = 0;
  bool stopped_ = false;
};

/// Thread-safe. Mesh and hierarchy need not outlive it.
class IntFastScene {
 public:
  IntFastScene(const IntMesh& mesh, const Bvh& bvh, const hls::WorldBits& bits, VectorWidth width);

  /// As IntTriangles has it.
  void walk(const IntRay& ray, IntVisitor& visitor) const;

 private:
  FloatRays rays_;
  std::unique_ptr<FastScene> scene_;
};

/// The same for instances, which must outlive it.
class FastInstances final : public IntTriangles {
 public:
  FastInstances(const IntInstances& world, VectorWidth width);

  void walk(const IntRay& ray, std::uint8_t mask, IntVisitor& visitor) const override;
  [[nodiscard]] IntTriangle triangle(std::uint32_t number) const override { return world_.triangle(number); }
  /// After IntInstances::place() of instances from `first` on; `moved` has their entries.
  void follow(std::uint32_t first, std::size_t count, std::span<const std::uint32_t> moved);

 private:
  const IntInstances& world_;
  FloatRays rays_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::unique_ptr<FastScene>> parts_;  ///< by mesh and node
  std::vector<const FastScene*> scenes_;                                                 ///< by entry
  std::vector<CornerMap> maps_;                                                          ///< by instance
  std::unique_ptr<FastBoxes> top_;  ///< null: no instance
};

}  // namespace hitpipe::ref
