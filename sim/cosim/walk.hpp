// How a ray walks through a hierarchy with the answers of a unit: for a unit that tests one box at a time,
// and for one that tests two. Each has a traversal, asks for tests (ask), takes results (answer), and names
// the boxes that a test answered for (each_box).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "rays/trace/walk.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/software/feed.hpp"
#include "sim/software/place_of_result.hpp"

namespace hitpipe::sim {

struct WalkScene {
  const SceneFeed* feed;
  const ref::Bvh* bvh;
  const ref::Mesh* mesh;
};

class OneBoxWalk {
 public:
  using Traversal = ref::BoxWalk<ref::FloatWorld>;

  OneBoxWalk(const WalkScene& scene, std::span<const hls::Result> results)
      : scene_(scene), hit_(rtl::place_of_hit(results)) {}

  [[nodiscard]] Traversal start(RayFeed& rays, std::size_t slot, const ref::Ray& ray, ref::Query query,
                                ref::Loads loads = {}) const {
    rays.start(slot, ray);
    return {*scene_.bvh, ref::FloatWorld(*scene_.mesh, *scene_.bvh, ray, loads), query};
  }
  static void ask(RayFeed& rays, std::size_t slot, const Traversal& traversal, std::int64_t* operands) {
    rays.operands(slot, {traversal.node(), traversal.length()}, operands);
  }
  void answer(const RayFeed& /*rays*/, std::size_t /*slot*/, Traversal& traversal,
              const std::int64_t* results) const {
    traversal.answer(results[hit_] != 0);
  }
  /// Calls visit(box, whether it was hit) for the test that waits for its answer.
  template <class Visit>
  void each_box(const Traversal& traversal, const std::int64_t* results, Visit&& visit) const {
    visit(scene_.bvh->nodes[traversal.node()].box, results[hit_] != 0);
  }

 private:
  WalkScene scene_;
  std::size_t hit_;
};

/// What a unit for two boxes says, in the places of its results.
class PairResults {
 public:
  /// Throws as place_of_result().
  explicit PairResults(std::span<const hls::Result> results);

  [[nodiscard]] bool hit(unsigned box, const std::int64_t* results) const { return results[hit_[box]] != 0; }
  [[nodiscard]] ref::PairAnswer answer(const std::int64_t* results) const {
    ref::PairAnswer answer;
    for (unsigned box = 0; box < 2; ++box) {
      answer.hit[box] = hit(box, results);
      answer.interval[box] = {results[near_[box]], results[far_[box]]};
    }
    answer.second_first = results[order_] != 0;
    return answer;
  }

 private:
  std::array<std::size_t, 2> hit_, near_, far_;
  std::size_t order_;
};

class PairWalk {
 public:
  using Traversal = ref::RecordWalk<ref::FloatWorld, ref::BvhPairs>;

  PairWalk(const WalkScene& scene, std::span<const hls::Result> results)
      : scene_(scene), records_(*scene.bvh), results_(results) {}

  [[nodiscard]] Traversal start(RayFeed& rays, std::size_t slot, const ref::Ray& ray, ref::Query query,
                                ref::Loads loads = {}) const {
    rays.start(slot, ray);
    return {records_, ref::FloatWorld(*scene_.mesh, *scene_.bvh, ray, loads), query,
            rays.in_results(slot, ray.length)};
  }
  static void ask(RayFeed& rays, std::size_t slot, const Traversal& traversal, std::int64_t* operands) {
    rays.operands(slot, {traversal.record(), traversal.length(), traversal.parent()}, operands);
  }
  void answer(const RayFeed& rays, std::size_t slot, Traversal& traversal,
              const std::int64_t* results) const {
    traversal.answer(results_.answer(results), [&](float length) { return rays.in_results(slot, length); });
  }
  template <class Visit>
  void each_box(const Traversal& traversal, const std::int64_t* results, Visit&& visit) const {
    const std::uint32_t first = records_.first_node(traversal.record());
    for (unsigned box = 0; box < traversal.boxes(); ++box)
      visit(scene_.bvh->nodes[first + box].box, results_.hit(box, results));
  }

 private:
  WalkScene scene_;
  ref::BvhPairs records_;
  PairResults results_;
};

/// Calls call(walk) with the walk that the feed is for.
template <class Call>
void with_walk(const WalkScene& scene, std::span<const hls::Result> results, Call&& call) {
  if (scene.feed->boxes_per_test() == 2) {
    call(PairWalk(scene, results));
  } else {
    call(OneBoxWalk(scene, results));
  }
}

}  // namespace hitpipe::sim
