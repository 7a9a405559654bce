// What rays ask in the float world, for the fast walk: the exact test of each triangle decides.
#pragma once

#include <bit>
#include <cstddef>

#include "rays/exact/exact_triangle.hpp"
#include "rays/exact/float_crossing.hpp"
#include "rays/trace/fast_walk.hpp"

namespace hitpipe::ref {

/// The nearest hit, or any. Ray and mesh must outlive it.
class HitSink final : public FastSink {
 public:
  HitSink(const Mesh& mesh, const Ray& ray, bool any) : mesh_(mesh), ray_(ray), any_(any) {}

  AfterLeaf meets(const TrianglePack& pack, unsigned may_hit) override {
    AfterLeaf after = AfterLeaf::same;
    for (; may_hit != 0; may_hit &= may_hit - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(may_hit));
      if (!intersect_triangle(mesh_, pack.triangles[lane], pack.at(lane), ray_, hit_)) continue;
      if (any_) return AfterLeaf::stop;
      after = AfterLeaf::shorter;
    }
    return after;
  }
  [[nodiscard]] float length() const override { return cull_length(hit_); }
  [[nodiscard]] const Hit& hit() const { return hit_; }

 private:
  const Mesh& mesh_;
  const Ray& ray_;
  Hit hit_;
  bool any_;
};

/// visit(triangle, crossing) of every hit, in any order.
template <class Visit>
class FloatCrossingSink final : public FastSink {
 public:
  FloatCrossingSink(const Ray& ray, const Visit& visit) : ray_(ray), visit_(visit) {}

  AfterLeaf meets(const TrianglePack& pack, unsigned may_hit) override {
    for (; may_hit != 0; may_hit &= may_hit - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(may_hit));
      if (const auto found = float_crossing(pack.at(lane), ray_)) visit_(pack.triangles[lane], *found);
    }
    return AfterLeaf::same;
  }
  [[nodiscard]] float length() const override { return ray_.length; }

 private:
  const Ray& ray_;
  const Visit& visit_;
};

}  // namespace hitpipe::ref
