// The walk of a ray of the integer world with a box unit's answers: for a unit that tests one box at a time,
// and for one that tests two.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hls/box/int_major_operands.hpp"
#include "hls/box/int_major_pair_operands.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/cosim/walk.hpp"
#include "sim/designs/major_design.hpp"
#include "sim/feeds/set_up_feed.hpp"
#include "sw_ref/world/int_pair_traversal.hpp"
#include "sw_ref/world/int_scene.hpp"
#include "sw_ref/world/int_traversal.hpp"

namespace hitpipe::sim {

/// The boxes of a scene as box units read them. The scene must outlive it.
struct WorldBoxes {
  WorldBoxes() = default;
  WorldBoxes(const ref::IntScene& its_scene, const hls::MajorBits& its_bits)
      : scene(&its_scene), bits(its_bits) {
    if (!its_scene.bvh) return;
    boxes = ref::int_boxes(its_scene.mesh, *its_scene.bvh);
    pairs = ref::int_pairs(boxes, *its_scene.bvh);
  }

  const ref::IntScene* scene = nullptr;
  hls::MajorBits bits{};
  std::vector<ref::IntBox> boxes;     ///< by node
  std::vector<ref::PairBoxes> pairs;  ///< by record of ref::BvhPairs
};

/// One ray after the other.
class OneBoxOfWorld {
 public:
  OneBoxOfWorld(const WorldBoxes& world, std::span<const hls::Result> results)
      : world_(&world), ports_(world.bits), hit_(rtl::place_of_hit(results)) {}

  void start(const ref::IntRay& ray, ref::Query query) {
    walk_.emplace(*world_->scene->bvh, ray, query);
    put_major_ray(ref::major_ray(ray, world_->bits), in_);
  }
  [[nodiscard]] ref::IntTraversal& walk() { return *walk_; }
  /// The operands of the test that the walk waits for.
  void write(std::int64_t* out) {
    in_.len = ref::in_box_units(walk_->length(), world_->scene->bits, world_->bits);
    ports_.write(in_, out);
    ports_.write_box(world_->boxes[walk_->node()], out);
  }
  /// Returns how many boxes are hit.
  unsigned answer(const std::int64_t* results) {
    const bool met = results[hit_] != 0;
    walk_->answer_box(met);
    return met ? 1 : 0;
  }

 private:
  using Operands = hls::IntMajorOperands<Words, hls::MajorBits>;

  const WorldBoxes* world_;
  PortOrder<Operands, hls::MajorBits> ports_;
  std::size_t hit_;
  Operands in_{};
  std::optional<ref::IntTraversal> walk_;
};

class TwoBoxesOfWorld {
 public:
  TwoBoxesOfWorld(const WorldBoxes& world, std::span<const hls::Result> results)
      : world_(&world), ports_(world.bits), results_(results) {}

  void start(const ref::IntRay& ray, ref::Query query) {
    walk_.emplace(*world_->scene->bvh, ray, query, world_->scene->bits, world_->bits);
    put_major_ray(ref::major_ray(ray, world_->bits), in_);
  }
  [[nodiscard]] ref::IntPairTraversal& walk() { return *walk_; }
  void write(std::int64_t* out) {
    put_pair(walk_->parent(), world_->pairs[walk_->record()], in_);
    ports_.write(in_, out);
  }
  unsigned answer(const std::int64_t* results) {
    const ref::PairAnswer answer = results_.answer(results);
    const unsigned boxes = walk_->boxes();
    walk_->answer_boxes(answer);
    return (answer.hit[0] ? 1U : 0U) + (answer.hit[1] && boxes == 2 ? 1U : 0U);
  }

 private:
  using Operands = hls::IntMajorPairOperands<Words, hls::MajorBits>;

  const WorldBoxes* world_;
  PortOrder<Operands, hls::MajorBits> ports_;
  PairResults results_;
  Operands in_{};
  std::optional<ref::IntPairTraversal> walk_;
};

}  // namespace hitpipe::sim
