// The walk of a ray of the integer world with a box unit's answers: for a unit that tests one box at a time,
// and for one that tests two.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hls/box/int_major_operands.hpp"
#include "hls/box/int_major_pair_operands.hpp"
#include "rays/trace/int_world.hpp"
#include "rays/world/int_boxes.hpp"
#include "rays/world/int_scene.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "sim/cosim/walk.hpp"
#include "sim/designs/major_design.hpp"
#include "sim/designs/set_up_feed.hpp"

namespace hitpipe::sim {

/// The boxes of a scene as box units read them. The scene must outlive it.
struct WorldBoxes {
  WorldBoxes() = default;
  WorldBoxes(const ref::IntScene& its_scene, const hls::MajorBits& its_bits)
      : scene(&its_scene), bits(its_bits) {
    if (!its_scene.bvh) return;
    boxes = ref::int_boxes(its_scene.mesh.triangles, *its_scene.bvh);
    records.emplace(*its_scene.bvh);
    pairs = ref::int_pairs(boxes, *its_scene.bvh);
  }

  const ref::IntScene* scene = nullptr;
  hls::MajorBits bits{};
  std::vector<ref::IntBox> boxes;  ///< by node
  std::optional<ref::BvhPairs> records;
  std::vector<ref::PairBoxes> pairs;  ///< by record
};

/// One ray after the other.
class OneBoxOfWorld {
 public:
  OneBoxOfWorld(const WorldBoxes& world, std::span<const hls::Result> results)
      : world_(&world), ports_(world.bits), hit_(rtl::place_of_hit(results)) {}

  void start(const ref::IntRay& ray, ref::Query query) {
    const ref::Bvh& bvh = *world_->scene->bvh;
    walk_.emplace(bvh, ref::IntWorld(bvh, ray), query);
    put_major_ray(ref::major_ray(ray, world_->bits), in_);
  }
  [[nodiscard]] const ref::IntBoxWalk& walk() const { return *walk_; }
  void answer_triangle(bool met, std::int64_t t) { walk_->answer_triangle(met, t); }
  /// The operands of the test that the walk waits for.
  void write(std::int64_t* out) {
    in_.len = ref::in_box_units(walk_->length(), world_->scene->bits, world_->bits);
    ports_.write(in_, out);
    ports_.write_box(world_->boxes[walk_->node()], out);
  }
  /// Returns how many boxes are hit.
  unsigned answer(const std::int64_t* results) {
    const bool met = results[hit_] != 0;
    walk_->answer(met);
    return met ? 1 : 0;
  }

 private:
  using Operands = hls::IntMajorOperands<Words, hls::MajorBits>;

  const WorldBoxes* world_;
  PortOrder<Operands, hls::MajorBits> ports_;
  std::size_t hit_;
  Operands in_{};
  std::optional<ref::IntBoxWalk> walk_;
};

class TwoBoxesOfWorld {
 public:
  TwoBoxesOfWorld(const WorldBoxes& world, std::span<const hls::Result> results)
      : world_(&world), ports_(world.bits), results_(results) {}

  void start(const ref::IntRay& ray, ref::Query query) {
    walk_.emplace(*world_->records, ref::IntWorld(*world_->scene->bvh, ray), query, in_results(ray.length));
    put_major_ray(ref::major_ray(ray, world_->bits), in_);
  }
  [[nodiscard]] const ref::IntRecordWalk& walk() const { return *walk_; }
  void answer_triangle(bool met, std::int64_t t) {
    walk_->answer_triangle(met, t, [&](std::int64_t length) { return in_results(length); });
  }
  void write(std::int64_t* out) {
    put_pair(walk_->parent(), world_->pairs[walk_->record()], in_);
    ports_.write(in_, out);
  }
  unsigned answer(const std::int64_t* results) {
    const ref::PairAnswer answer = results_.answer(results);
    const unsigned boxes = walk_->boxes();
    walk_->answer(answer, [&](std::int64_t length) { return in_results(length); });
    return (answer.hit[0] ? 1U : 0U) + (answer.hit[1] && boxes == 2 ? 1U : 0U);
  }

 private:
  using Operands = hls::IntMajorPairOperands<Words, hls::MajorBits>;

  [[nodiscard]] std::int64_t in_results(std::int64_t length) const {
    return ref::in_box_units(length, world_->scene->bits, world_->bits);
  }

  const WorldBoxes* world_;
  PortOrder<Operands, hls::MajorBits> ports_;
  PairResults results_;
  Operands in_{};
  std::optional<ref::IntRecordWalk> walk_;
};

}  // namespace hitpipe::sim
