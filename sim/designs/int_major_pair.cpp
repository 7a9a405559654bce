// The operands of hls::IntMajorPairOperands (docs/never_misses.md).
#include "sw_ref/trace/int_major_pair.hpp"

#include <algorithm>
#include <array>
#include <optional>

#include "hls/box/int_major_pair_operands.hpp"
#include "rays/world/pair_nodes.hpp"
#include "sim/designs/major_design.hpp"
#include "sim/designs/set_up_feed.hpp"
#include "sim/software/place_of_result.hpp"
#include "sw_ref/judge/adversary/random.hpp"

namespace hitpipe::sim {

void put_pair(const ref::RayInterval& parent, const ref::PairBoxes& boxes,
              hls::IntMajorPairOperands<Words, hls::MajorBits>& in) {
  in.parent_near = parent.near;
  in.parent_far = parent.far;
  put(boxes.planes.min, in.xmin, in.ymin, in.zmin);
  put(boxes.planes.max, in.xmax, in.ymax, in.zmax);
  const auto owner = [&](unsigned plane) -> std::int64_t { return boxes.owners >> plane & 1U; };
  put(std::array{owner(0), owner(1), owner(2)}, in.own_xmin, in.own_ymin, in.own_zmin);
  put(std::array{owner(3), owner(4), owner(5)}, in.own_xmax, in.own_ymax, in.own_zmax);
}

namespace {

using hls::MajorBits;

using Operands = hls::IntMajorPairOperands<Words, MajorBits>;
using Ports = PortOrder<Operands, MajorBits>;

class PairRays final : public RayFeed {
 public:
  PairRays(const std::vector<ref::PairBoxes>& boxes, const MajorBits& bits, std::size_t slots)
      : boxes_(boxes), bits_(bits), ports_(bits), slots_(slots) {}

  void start(std::size_t slot, const ref::Ray& ray) override {
    slots_[slot].set_up.emplace(ray, bits_);
    put_major_ray(slots_[slot].set_up->ray(), slots_[slot].operands);
  }
  void operands(std::size_t slot, const Question& asked, std::int64_t* out) override {
    put_pair(asked.parent, boxes_[asked.record], slots_[slot].operands);
    ports_.write(slots_[slot].operands, out);
  }
  [[nodiscard]] std::int64_t in_results(std::size_t slot, float length) const override {
    return slots_[slot].set_up->length(length);
  }

 private:
  const std::vector<ref::PairBoxes>& boxes_;
  struct Slot {
    std::optional<MajorSetup> set_up;
    Operands operands{};
  };

  MajorBits bits_;
  Ports ports_;
  std::vector<Slot> slots_;
};

class PairScene final : public SceneFeed {
 public:
  PairScene(const MajorBits& bits, const ref::Bvh& bvh) : bits_(bits), boxes_(bvh.nodes.size() + 1) {
    // PairNodes numbers branches alone, in the same order.
    const ref::PairNodes records(bvh, bits.coord, bits.finer);
    std::uint32_t record = 0;
    boxes_[0] = records.boxes(record++);
    for (std::size_t node = 0; node < bvh.nodes.size(); ++node)
      if (!bvh.nodes[node].is_leaf()) boxes_[node + 1] = records.boxes(record++);
  }

  [[nodiscard]] std::unique_ptr<RayFeed> unit(std::size_t slots) const override {
    return std::make_unique<PairRays>(boxes_, bits_, slots);
  }
  [[nodiscard]] int boxes_per_test() const override { return 2; }

 private:
  MajorBits bits_;
  std::vector<ref::PairBoxes> boxes_;  ///< by record of ref::BvhPairs
};

std::unique_ptr<SceneFeed> pair_feed(const Format& format, const ref::Bvh& bvh) {
  return std::make_unique<PairScene>(float_world(format), bvh);
}

/// Judges one box as the first of two. Its sibling reaches beyond it on some faces and ends before it on
/// others, so some of its planes are its own and some the parent's. The unit tests the parent first, as it
/// would a root. The answer does not depend on the sibling.
class PairTest final : public BoxTest {
 public:
  PairTest(const rtl::Design& design, const Format& format)
      : evaluate_(design.evaluate(format)),
        format_(format),
        limit_(format.as<MajorBits>().largest_plane()),
        ports_(format.as<MajorBits>()),
        operands_(ports_.count()),
        results_(evaluate_.result_count()) {
    const std::vector<hls::Result> results = design.results(format);
    second_hit_ = place_of_result(results, hls::Meaning::hit, 1);
    near_ = place_of_result(results, hls::Meaning::entry, 0);
    far_ = place_of_result(results, hls::Meaning::exit, 0);
  }

  void start(const ref::Ray& ray) override {
    const MajorSetup set_up(ray, format_.as<MajorBits>());
    put_major_ray(set_up.ray(), in_);
    length_ = set_up.length(ray.length);
  }

  bool hit(const ref::Aabb& box) override {
    const ref::IntBox first = on_grid(box);
    return both(first, sibling(first))[0];
  }
  std::array<bool, 2> siblings(const ref::Aabb& first, const ref::Aabb& second) override {
    return both(on_grid(first), on_grid(second));
  }
  void meet(const ref::Ray& ray, std::span<const ref::Aabb> boxes, std::span<bool> out) const override {
    if (!integer_meet(ray, boxes, format_, out)) BoxTest::meet(ray, boxes, out);
  }
  [[nodiscard]] std::span<const std::int64_t> operands() const override { return operands_; }
  [[nodiscard]] std::span<const std::int64_t> results() const override { return results_; }

 private:
  /// The same for the same box. It may be turned inside out: only its planes count.
  [[nodiscard]] ref::IntBox sibling(const ref::IntBox& box) const {
    std::uint64_t seed = 0;
    for (const auto& corner : {box.min, box.max})
      for (const std::int32_t plane : corner)
        seed = seed * ref::golden_step + static_cast<std::uint64_t>(plane);
    ref::adversary::Random random(seed);
    ref::IntBox other = box;
    for (auto* const corner : {&other.min, &other.max}) {
      for (std::int32_t& plane : *corner) {
        // Of any magnitude, to either side.
        const auto away = static_cast<std::int64_t>(random.below(std::uint64_t{1} << random.between(0, 31)));
        const std::int64_t moved = random.coin() ? plane + away : plane - away;
        plane = static_cast<std::int32_t>(std::clamp(moved, -limit_, limit_));
      }
    }
    return other;
  }

  [[nodiscard]] ref::IntBox on_grid(const ref::Aabb& box) const {
    ref::IntBox rounded;
    major_boxes({&box, 1}, format_, {&rounded, 1});
    return rounded;
  }

  std::array<bool, 2> both(const ref::IntBox& first, const ref::IntBox& second) {
    if (!test({0, length_}, {union_of(first, second), 0})) return {false, false};
    const bool hit = test({results_[near_], results_[far_]}, ref::pair_boxes(first, second));
    return {hit, results_[second_hit_] != 0};
  }

  bool test(const ref::RayInterval& parent, const ref::PairBoxes& boxes) {
    put_pair(parent, boxes, in_);
    ports_.write(in_, operands_.data());
    evaluate_(operands_.data(), results_.data());
    return evaluate_.hit(results_.data());
  }

  rtl::Evaluate evaluate_;
  Format format_;
  std::int64_t limit_;  ///< of a plane
  Ports ports_;
  std::vector<std::int64_t> operands_;
  std::vector<std::int64_t> results_;
  std::size_t second_hit_ = 0;
  std::size_t near_ = 0;
  std::size_t far_ = 0;
  Operands in_{};
  std::int64_t length_ = 0;
};

std::unique_ptr<BoxTest> pair_test(const rtl::Design& design, const Format& format) {
  return std::make_unique<PairTest>(design, format);
}

std::unique_ptr<ref::Tracer> int_major_pair_tracer(const TracedUnit& unit, const ref::Mesh& mesh,
                                                   const ref::Bvh& bvh) {
  return ref::major_pair_tracer(float_world(unit.format), mesh, bvh);
}

std::size_t pair_bytes_per_node(const Format& format, const ref::CoarseAxes& /*none*/) {
  // A record is for two nodes.
  return (ref::PairNodes::record_bytes(format.as<MajorBits>().coord) + 1) / 2;
}

NodeRecords pair_records(const Format& format, const ref::Bvh& bvh) {
  const MajorBits bits = float_world(format);
  const ref::PairNodes records(bvh, bits.coord, bits.finer);
  return {records.bytes_per_record, {records.bytes().begin(), records.bytes().end()}};
}

}  // namespace

Software int_major_pair_software() {
  Software software = major_design_software();
  software.feed = pair_feed;
  software.box_test = pair_test;
  software.tracer = int_major_pair_tracer;
  software.bytes_per_node = pair_bytes_per_node;
  software.records = pair_records;
  return software;
}

}  // namespace hitpipe::sim
