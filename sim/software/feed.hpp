// Turns rays and boxes into a design's operands. This is the set-up that surrounds a unit, outside its
// pipeline.
#pragma once

#include <cstdint>
#include <memory>
#include <stdexcept>

#include "rays/mesh/ray.hpp"
#include "rays/tree/bvh.hpp"
#include "rays/world/coarse_axes.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::sim {

/// What a test asks about a ray.
struct Question {
  std::uint32_t record;       ///< a BVH node; for two boxes at a time, a record of ref::BvhPairs
  float length;               ///< where the ray is cut
  ref::RayInterval parent{};  ///< for two boxes at a time: where the ray is within their parent
};

/// The set-up of rays for one unit, with a ray in each slot. Threads must not share it.
class RayFeed {
 public:
  virtual ~RayFeed() = default;
  /// Sets up the ray of a slot. The ray must be acceptable (rays/exact/box_referee.hpp).
  virtual void start(std::size_t slot, const ref::Ray& ray) = 0;
  /// The operands, in port order, of a test of the slot's ray.
  virtual void operands(std::size_t slot, const Question& asked, std::int64_t* out) = 0;
  /// A length of the slot's ray in units of the design's entry and exit results. Only a design that answers
  /// for two boxes at a time needs it.
  [[nodiscard]] virtual std::int64_t in_results(std::size_t /*slot*/, float /*length*/) const {
    throw std::logic_error("a feed for one box at a time has no unit of distances");
  }
};

/// The boxes of a hierarchy as the design reads them. They are made once for all units and must outlive them.
class SceneFeed {
 public:
  virtual ~SceneFeed() = default;
  [[nodiscard]] virtual std::unique_ptr<RayFeed> unit(std::size_t slots) const = 0;
  /// One or two.
  [[nodiscard]] virtual int boxes_per_test() const { return 1; }
};

/// The format must be one of the design's. Coarse axes are for designs with integer coordinates. Throws
/// std::runtime_error when the design has no set-up, or one for another number of boxes, and
/// std::out_of_range for a box outside the cube. RayFeed::operands() throws std::out_of_range when an origin
/// or box leaves the coarse grid. The hierarchy need not outlive the feed.
[[nodiscard]] std::unique_ptr<SceneFeed> make_feed(const rtl::Design& design, const Format& format,
                                                   const ref::Bvh& bvh, const ref::CoarseAxes& coarse = {});

}  // namespace hitpipe::sim
