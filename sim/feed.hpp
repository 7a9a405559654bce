// Turns rays and boxes into a design's operands. This is the set-up that surrounds a unit, outside its
// pipeline.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>
#include <vector>

#include "hls/box/major_format.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sw_ref/hierarchy/bvh.hpp"
#include "sw_ref/hierarchy/pair_nodes.hpp"
#include "sw_ref/quantise/coarse_axes.hpp"
#include "sw_ref/scene/ray.hpp"
#include "sw_ref/trace/int_major.hpp"

namespace hitpipe::sim {

/// The set-up of rays for one unit, with a ray in each slot. Threads must not share it.
class RayFeed {
 public:
  virtual ~RayFeed() = default;
  /// Sets up the ray of a slot. The ray must be acceptable (sw_ref/judge/box_referee.hpp).
  virtual void start(std::size_t slot, const ref::Ray& ray) = 0;
  /// The operands, in port order: the slot's ray, cut at `length`, against the box of a BVH node.
  virtual void operands(std::size_t slot, std::uint32_t node, float length, std::int64_t* out) const = 0;
  /// The same for a design that answers for two boxes at a time: the slot's ray against a record of
  /// SceneFeed::pairs(), while it is within the record's parent.
  virtual void pair_operands(std::size_t /*slot*/, std::uint32_t /*record*/,
                             const ref::MajorInterval& /*parent*/, std::int64_t* /*out*/) const {
    throw std::logic_error("a feed for one box at a time has no operands for two");
  }
};

/// The hierarchy as a design reads it that answers for two boxes at a time.
struct PairRecords {
  ref::PairNodes records;
  hls::MajorBits bits;
};

/// The boxes of a hierarchy as the design reads them. They are made once for all units and must outlive them.
class SceneFeed {
 public:
  virtual ~SceneFeed() = default;
  [[nodiscard]] virtual std::unique_ptr<RayFeed> unit(std::size_t slots) const = 0;
  /// Null for a design that answers for one box at a time.
  [[nodiscard]] virtual const PairRecords* pairs() const { return nullptr; }
};

/// The format must be one of the design's. Coarse axes are for designs with integer coordinates. Throws
/// std::runtime_error when the design has no set-up, or one for another number of boxes, and
/// std::out_of_range for a box outside the cube. RayFeed::operands() throws std::out_of_range when an origin
/// or box leaves the coarse grid. The hierarchy need not outlive the feed.
[[nodiscard]] std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, const rtl::Format& format,
                                                   const ref::Bvh& bvh, const ref::CoarseAxes& coarse = {});

}  // namespace hitpipe::sim
