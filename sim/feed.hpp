// Turns rays and boxes into a design's operands: the set-up that surrounds a unit, outside its pipeline.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
#include "rtl_gen/catalogue/format.hpp"
#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/geometry/ray.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"

namespace hitpipe::sim {

/// The set-up of rays for one unit: a ray in each slot. Not shared between threads.
class RayFeed {
 public:
  virtual ~RayFeed() = default;
  /// Sets up the ray of a slot. The ray must be acceptable (sw_ref/exact/box_referee.hpp).
  virtual void start(std::size_t slot, const ref::Ray& ray) = 0;
  /// The operands, in port order, of the slot's ray, cut at `length`, against the box of a BVH node.
  virtual void operands(std::size_t slot, std::uint32_t node, float length, std::int64_t* out) const = 0;
};

/// The boxes of a hierarchy as the design reads them, made once for all units, which it must outlive.
class SceneFeed {
 public:
  virtual ~SceneFeed() = default;
  [[nodiscard]] virtual std::unique_ptr<RayFeed> unit(std::size_t slots) const = 0;
};

/// The format must be one of the design's; coarse axes are of integer designs. Throws std::runtime_error when
/// the design reads operands that no set-up makes, std::out_of_range for a box outside the cube; its operands
/// do for an origin or box that leaves the coarse grid. The hierarchy need not outlive the feed.
[[nodiscard]] std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, rtl::Format format,
                                                   const ref::Bvh& bvh, const ref::CoarseAxes& coarse = {});

}  // namespace hitpipe::sim
