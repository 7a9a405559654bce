// Rays and triangles of the integer world, for the walks of rays/trace/walk.hpp: they pause at each triangle.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rays/trace/walk.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_triangle.hpp"

namespace hitpipe::ref {

/// Bits 0..2: the direction is negative along x, y, z.
[[nodiscard]] inline unsigned direction_class(const std::array<bool, 3>& negative) {
  return static_cast<unsigned>(negative[0]) | static_cast<unsigned>(negative[1]) << 1U |
         static_cast<unsigned>(negative[2]) << 2U;
}
[[nodiscard]] inline unsigned direction_class(const IntRay& ray) {
  return direction_class(ray.negative);
}

/// An empty mesh has no hierarchy: see IntTracer.
class IntWorld {
 public:
  static constexpr bool asks_triangles = true;

  IntWorld(const Bvh& bvh, const IntRay& ray) : IntWorld(bvh, ray.length, direction_class(ray)) {}
  IntWorld(const Bvh& bvh, std::int64_t length, unsigned order_class)
      : order_(bvh.order), length_(length), class_(order_class) {}

  [[nodiscard]] unsigned order_class() const { return class_; }
  /// No T beyond it is of interest: the length of the ray, or T of the best hit. Boxes are cut there.
  [[nodiscard]] std::int64_t length() const { return hit_.found() ? hit_.t : length_; }
  [[nodiscard]] const IntHit& hit() const { return hit_; }
  [[nodiscard]] bool at_triangle() const { return triangle_ != end_; }
  [[nodiscard]] std::uint32_t triangle() const { return order_[triangle_]; }
  void loads(std::uint32_t /*node*/) const {}

  bool enter_leaf(std::uint32_t first, std::int32_t count, Query /*query*/, TraceCounts& /*counts*/) {
    triangle_ = first;
    end_ = first + static_cast<std::uint32_t>(count);
    return false;
  }
  /// Returns whether this hit is better than all before.
  bool answer(bool met, std::int64_t t) {
    const bool better = met && keep_better(t, triangle(), hit_);
    ++triangle_;
    return better;
  }

 private:
  std::span<const std::uint32_t> order_;
  std::int64_t length_;
  IntHit hit_;
  std::uint32_t triangle_ = 0, end_ = 0;  ///< places in the order; equal: the walk waits for boxes
  unsigned class_;
};

using IntBoxWalk = BoxWalk<IntWorld>;
using IntRecordWalk = RecordWalk<IntWorld, BvhPairs>;

/// By record of BvhPairs: the two boxes of a branch. Record 0 has the root's box alone. `boxes` is of
/// int_boxes() for the same hierarchy.
[[nodiscard]] inline std::vector<PairBoxes> int_pairs(std::span<const IntBox> boxes, const Bvh& bvh) {
  std::vector<PairBoxes> pairs(bvh.nodes.size() + 1);
  pairs[0] = {boxes[0], 0};
  for (std::size_t i = 0; i < bvh.nodes.size(); ++i)
    if (const BvhNode& node = bvh.nodes[i]; !node.is_leaf())
      pairs[i + 1] = pair_boxes(boxes[node.first], boxes[node.first + 1]);
  return pairs;
}

}  // namespace hitpipe::ref
