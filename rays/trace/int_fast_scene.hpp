// The fast walk in the integer world. Boxes and corners are integers in binary32, which holds them. A ray is rounded
// where binary32 does not hold it, and boxes and the filter of triangles allow for that. Integers decide what is hit.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>

#include "hls/world/world_format.hpp"
#include "rays/exact/binary32.hpp"
#include "rays/trace/fast_scene.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/int_mesh.hpp"
#include "rays/world/int_ray.hpp"

namespace hitpipe::ref {

/// Thread-safe. Mesh and hierarchy need not outlive it.
class IntFastScene {
 public:
  IntFastScene(const IntMesh& mesh, const Bvh& bvh, const hls::WorldBits& bits, VectorWidth width);

  /// meets(number, triangle) for each triangle that the ray may hit. It gives the T up to which the walk is of interest
  /// from then on, that T included; nothing: no change. Returns whether to go on.
  template <class Meets>
  void walk(const IntRay& ray, const Meets& meets) const;

 private:
  /// Units are those of corners, and the direction is 1 along the major axis.
  [[nodiscard]] Ray float_ray(const IntRay& ray) const;
  /// A hit at T lies below T + 1.
  [[nodiscard]] float box_length(std::int64_t t) const {
    return rounded_up(static_cast<double>(t + 1) * length_unit_);
  }

  std::unique_ptr<FastScene> scene_;
  float origin_unit_, direction_unit_;  ///< 2^-g, 2^-S
  double length_unit_;                  ///< 2^-(g+F)
  float allowance_;                     ///< of the filter, for rays that are rounded
};

/// What a walk of integers does after a triangle.
struct IntInterest {
  std::optional<std::int64_t> up_to{};
  bool stop = false;
};

template <class Meets>
void IntFastScene::walk(const IntRay& ray, const Meets& meets) const {
  class Sink final : public FastSink {
   public:
    Sink(const IntFastScene& its_scene, const Meets& its_meets) : scene(its_scene), ask(its_meets) {}
    AfterLeaf meets(const TrianglePack& pack, unsigned may_hit) override {
      AfterLeaf after = AfterLeaf::same;
      for (; may_hit != 0; may_hit &= may_hit - 1) {
        const auto lane = static_cast<std::size_t>(std::countr_zero(may_hit));
        IntTriangle triangle;
        for (std::size_t i = 0; i < 9; ++i)
          triangle.corners[i / 3][i % 3] = static_cast<std::int32_t>(pack.corners[i][lane]);
        const IntInterest interest = ask(pack.triangles[lane], triangle);
        if (interest.stop) return AfterLeaf::stop;
        if (!interest.up_to) continue;
        up_to = *interest.up_to;
        after = AfterLeaf::shorter;
      }
      return after;
    }
    [[nodiscard]] float length() const override { return scene.box_length(up_to); }

   private:
    const IntFastScene& scene;
    const Meets& ask;
    std::int64_t up_to = 0;
  };
  const Ray made = float_ray(ray);
  Sink sink(*this, meets);
  FastWork work;
  scene_->walk(made, scene_->largest_reach(made) * allowance_, sink, work);
}

}  // namespace hitpipe::ref
