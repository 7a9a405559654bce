// Turns rays and boxes into a design's operands: the set-up that surrounds a unit, outside its pipeline.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "rtl_gen/catalogue/design.hpp"
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

/// The format must be one of the design's; coarse axes are for designs whose coordinates are integers. Throws
/// std::runtime_error when the design has no set-up or answers for several boxes at a time, std::out_of_range
/// for a box outside the cube; RayFeed::operands() throws that for an origin or box that leaves the coarse
/// grid. The hierarchy need not outlive the feed.
[[nodiscard]] std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, const rtl::Format& format,
                                                   const ref::Bvh& bvh, const ref::CoarseAxes& coarse = {});

}  // namespace hitpipe::sim
