#include "sim/cosim/world_tracer.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include "hls/world/core_format.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/designs/major_design.hpp"
#include "sim/machine/verilated_machine.hpp"
#include "sim/software.hpp"
#include "sw_ref/trace/leaf_test.hpp"
#include "sw_ref/world/int_tracer.hpp"
#include "sw_ref/world/int_traversal.hpp"

namespace hitpipe::sim {

namespace world_units {

constexpr int most_in_flight = 65'536;  // a tag has 16 bits
constexpr const char* divider_name = "divider";

/// One of the two units, with the tests that are on their way through it.
class Station {
 public:
  explicit Station(const VerilatedDesign& design, const rtl::Evaluate& evaluate)
      : model_(design),
        evaluate_(evaluate),
        operands_(design.operand_count()),
        results_(design.results().size()),
        longest_silence_(design.latency() + design.unit().pipeline.interval() + 1) {}

  void ask(std::uint32_t ray) { waiting_.push_back(ray); }
  [[nodiscard]] bool idle() const { return waiting_.empty() && sent_.empty(); }
  [[nodiscard]] bool hit(const std::int64_t* results) const { return evaluate_.hit(results); }
  [[nodiscard]] const WorldUnitCounts& counts() const { return counts_; }

  /// One cycle. write(ray, operands) gives the operands of the next ray's test; answered(ray, results) takes
  /// an answer.
  template <class Write, class Answered>
  void cycle(const Write& write, const Answered& answered) {
    Pins pins{.results = results_.data()};
    if (!waiting_.empty()) {
      write(waiting_.front(), operands_.data());
      pins.in_valid = true;
      pins.in_tag = static_cast<std::uint16_t>(waiting_.front());
    }
    model_.cycle(operands_.data(), pins);
    ++counts_.cycles;
    if (pins.in_valid && pins.in_ready) {
      Sent& sent = sent_.emplace_back(Sent{waiting_.front(), {}});
      evaluate_(operands_.data(), sent.expected.data());
      waiting_.pop_front();
    }
    if (!pins.out_valid) {
      if (!sent_.empty() && ++silent_ > longest_silence_)
        throw WrongHardware(fmt::format("{}: no answer within its latency", model_.design().unit().module));
      return;
    }
    silent_ = 0;
    if (sent_.empty()) {
      ++counts_.rtl_mismatches;
      return;
    }
    const Sent sent = sent_.front();
    sent_.pop_front();
    bool same = pins.out_tag == sent.ray;
    for (std::size_t i = 0; i < results_.size(); ++i) same = same && results_[i] == sent.expected[i];
    ++counts_.tests;
    counts_.hits += evaluate_.hit(results_.data()) ? 1 : 0;
    counts_.rtl_mismatches += same ? 0 : 1;
    answered(sent.ray, results_.data());
  }

 private:
  /// Answers keep the order of the tests.
  struct Sent {
    std::uint32_t ray;
    std::array<std::int64_t, rtl::Evaluate::most_results> expected;
  };

  Model model_;
  rtl::Evaluate evaluate_;
  std::vector<std::int64_t> operands_, results_;
  std::deque<std::uint32_t> waiting_;
  std::deque<Sent> sent_;
  WorldUnitCounts counts_;
  int silent_ = 0;
  int longest_silence_;
};

/// What the divider must know of the ray whose test it divides.
struct BestHit {
  std::uint32_t number;  ///< of the triangle that it was tested with
  std::int64_t t;        ///< of the best hit; the length before the first
  std::uint32_t best_number;
};

/// The divider, with the tests that wait for it or are in it.
class DividerStation {
 public:
  DividerStation(const VerilatedMachine& divider, const hls::CoreBits& bits)
      : verilog_(divider.another()),
        native_(rtl::machine_called(divider_name)->native(bits)),
        owners_(static_cast<std::size_t>(bits.rays())) {
    for (std::uint32_t i = 0; i < owners_.size(); ++i) free_.push_back(i);
    const Inputs none{};
    Outputs ignored;
    native_->step(none.data(), ignored.data(), true);
    verilog_->step(none.data(), ignored.data(), true);
  }

  /// `results` of a test with HIT: det and num in halves.
  void ask(std::uint32_t ray, const std::array<std::int64_t, 4>& halves) {
    waiting_.push_back({ray, halves});
  }
  [[nodiscard]] bool idle() const { return waiting_.empty() && free_.size() == owners_.size(); }
  [[nodiscard]] WorldUnitCounts& counts() { return counts_; }
  [[nodiscard]] const WorldUnitCounts& counts() const { return counts_; }

  /// One cycle. best(ray) gives a BestHit; answered(ray, t, closer) takes an answer.
  template <class Best, class Answered>
  void cycle(const Best& best, const Answered& answered) {
    Inputs in{};
    if (!waiting_.empty() && !free_.empty()) {
      const Waiting& next = waiting_.front();
      const std::uint32_t place = free_.front();
      free_.pop_front();
      owners_[place] = next.ray;
      in[0] = 1;
      in[1] = place;
      for (std::size_t i = 0; i < next.halves.size(); ++i)
        in[2 + i] = static_cast<rtl::Word>(static_cast<std::uint64_t>(next.halves[i]));
      waiting_.pop_front();
    }
    const BestHit found = best(owners_[asked_]);
    in[6] = found.number;
    in[7] = static_cast<rtl::Word>(found.t);
    in[8] = found.best_number;
    Outputs out, expected;
    native_->step(in.data(), expected.data(), false);
    verilog_->step(in.data(), out.data(), false);
    ++counts_.cycles;
    if (out != expected) ++counts_.rtl_mismatches;
    asked_ = static_cast<std::size_t>(out[0]);
    if (out[1] == 0) {
      if (++silent_ > longest_silence) throw WrongHardware("divider: no answer");
      return;
    }
    silent_ = 0;
    ++counts_.tests;
    counts_.hits += out[3] != 0 ? 1 : 0;
    free_.push_back(static_cast<std::uint32_t>(asked_));
    answered(owners_[asked_], static_cast<std::int64_t>(out[2]), out[3] != 0);
  }

 private:
  using Inputs = std::array<rtl::Word, 9>;
  using Outputs = std::array<rtl::Word, 4>;
  static constexpr int longest_silence = 100;
  struct Waiting {
    std::uint32_t ray;
    std::array<std::int64_t, 4> halves;
  };

  std::unique_ptr<VerilatedMachine> verilog_;
  std::unique_ptr<rtl::NativeMachine> native_;
  std::vector<std::uint32_t> owners_;  ///< rays, by their number in the divider
  std::deque<std::uint32_t> free_;
  std::deque<Waiting> waiting_;
  WorldUnitCounts counts_;
  std::size_t asked_ = 0;
  int silent_ = 0;
};

/// The box unit's operands of a ray.
class BoxOperands {
 public:
  using Operands = hls::IntMajorOperands<Words, hls::MajorBits>;

  BoxOperands(const hls::MajorBits& bits, const hls::WorldBits& world)
      : bits_(bits), world_(world), ports_(bits) {}
  void start(const ref::IntRay& ray) { put_major_ray(ref::major_ray(ray, bits_), in_); }
  void write(const ref::IntBox& box, std::int64_t length, std::int64_t* out) {
    in_.len = ref::in_box_units(length, world_, bits_);
    ports_.write(in_, out);
    ports_.write_box(box, out);
  }

 private:
  hls::MajorBits bits_;
  hls::WorldBits world_;
  PortOrder<Operands, hls::MajorBits> ports_;
  Operands in_{};
};

struct Scene {
  const ref::IntScene* scene;
  std::vector<ref::IntBox> boxes;
  hls::MajorBits box_bits;
  std::unique_ptr<VerilatedMachine> divider;
};

inline hls::CoreBits divider_format(const hls::WorldBits& world) {
  constexpr int ray_bits = 5;
  return {world, ray_bits};
}

/// The units of one thread.
class Stations {
 public:
  Stations(const Scene& scene, const WorldUnits& units)
      : scene_(scene),
        boxes_(*units.boxes, evaluate(*units.boxes)),
        triangles_(*units.triangles, evaluate(*units.triangles)),
        divider_(*scene.divider, divider_format(scene.scene->bits)),
        halves_(places_of_halves(units.triangles->results())),
        hit_(rtl::place_of_hit(units.boxes->results())) {
    for (int i = 0; i < units.rays_in_flight; ++i) slots_.emplace_back(scene, *units.triangles);
  }

  void run(const ref::TraceJob& job, ref::TraceCounts& counts) {
    std::size_t next = 0, ended = 0;
    for (Slot& slot : slots_) slot.ray = none;
    const auto step = [&](std::uint32_t number) {
      Slot& slot = slots_[number];
      while (slot.ray != none && slot.walk->done()) {
        job.triangles[slot.ray] = slot.walk->hit().triangle;
        const ref::TraceCounts work = slot.walk->counts();
        if (!job.work.empty()) job.work[slot.ray] = work;
        counts += work;
        ++ended;
        slot.ray = none;
        if (next < job.rays.size()) slot.start(next, job.rays[next], job.query), ++next;
      }
      if (slot.ray != none) (slot.walk->at_triangle() ? triangles_ : boxes_).ask(number);
    };
    for (std::uint32_t i = 0; i < slots_.size() && next < job.rays.size(); ++i) {
      slots_[i].start(next, job.rays[next], job.query);
      ++next;
      step(i);
    }
    while (ended < job.rays.size()) {
      if (!boxes_.idle())
        boxes_.cycle(
            [&](std::uint32_t ray, std::int64_t* out) {
              Slot& slot = slots_[ray];
              slot.box.write(scene_.boxes[slot.walk->node()], slot.walk->length(), out);
            },
            [&](std::uint32_t ray, const std::int64_t* results) {
              slots_[ray].walk->answer_box(results[hit_] != 0);
              step(ray);
            });
      if (!triangles_.idle())
        triangles_.cycle(
            [&](std::uint32_t ray, std::int64_t* out) {
              const Slot& slot = slots_[ray];
              slot.triangle->operands(scene_.scene->mesh.triangles[slot.walk->triangle()], out);
            },
            [&](std::uint32_t ray, const std::int64_t* results) {
              if (!triangles_.hit(results)) {
                slots_[ray].walk->answer_triangle(false, 0);
                step(ray);
                return;
              }
              slots_[ray].crossing = slots_[ray].triangle->crossing(results);
              std::array<std::int64_t, 4> halves;
              for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = results[halves_[i]];
              divider_.ask(ray, halves);
            });
      if (!divider_.idle())
        divider_.cycle(
            [&](std::uint32_t ray) { return best_of(*slots_[ray].walk); },
            [&](std::uint32_t ray, std::int64_t t, bool closer) {
              Slot& slot = slots_[ray];
              if (closer != is_closer(*slot.walk, slot.crossing) || (slot.crossing && slot.crossing->t != t))
                ++divider_.counts().rtl_mismatches;
              slot.walk->answer_triangle(closer, t);
              step(ray);
            });
    }
  }

  [[nodiscard]] const WorldUnitCounts& boxes() const { return boxes_.counts(); }
  [[nodiscard]] const WorldUnitCounts& triangles() const { return triangles_.counts(); }
  [[nodiscard]] const WorldUnitCounts& divisions() const { return divider_.counts(); }

 private:
  static BestHit best_of(const ref::IntTraversal& walk) {
    if (walk.done()) return {0, 0, 0};  // of an earlier test
    return {walk.at_triangle() ? walk.triangle() : 0, walk.length(),
            walk.hit().found() ? walk.hit().triangle : ref::IntHit::none};
  }
  /// What exact integers say; a crossing beyond the ray's length is none.
  static bool is_closer(const ref::IntTraversal& walk, const std::optional<ref::IntCrossing>& crossing) {
    ref::IntHit best = walk.hit();
    return crossing && ref::keep_better(crossing->t, walk.triangle(), best);
  }
  static std::array<std::size_t, 4> places_of_halves(const std::vector<hls::Result>& results) {
    using hls::Meaning;
    std::array<std::size_t, 4> places{};
    constexpr std::array wanted{Meaning::determinant, Meaning::determinant_low, Meaning::volume,
                                Meaning::volume_low};
    for (std::size_t i = 0; i < wanted.size(); ++i)
      places[i] = static_cast<std::size_t>(
          std::find_if(results.begin(), results.end(),
                       [&](const hls::Result& result) { return result.meaning == wanted[i]; }) -
          results.begin());
    return places;
  }

  static constexpr std::size_t none = ~std::size_t{0};

  static rtl::Evaluate evaluate(const VerilatedDesign& design) {
    return design.unit().design->evaluate(design.unit().format);
  }

  struct Slot {
    Slot(const Scene& its_scene, const VerilatedDesign& triangles)
        : scene(&its_scene),
          box(its_scene.box_bits, its_scene.scene->bits),
          triangle(make_triangle_test(*triangles.unit().design, triangles.unit().format)) {}
    void start(std::size_t number, const ref::Ray& its_ray, ref::Query query) {
      ray = number;
      const ref::IntRay made = ref::int_ray(its_ray, scene->scene->bits);
      walk.emplace(*scene->scene->bvh, made, query);
      box.start(made);
      triangle->start(made);
    }

    const Scene* scene;
    std::size_t ray = none;  ///< its place in the job
    std::optional<ref::IntTraversal> walk;
    BoxOperands box;
    std::unique_ptr<TriangleTest> triangle;
    std::optional<ref::IntCrossing> crossing{};  ///< of the test that is in the divider
  };

  const Scene& scene_;
  Station boxes_, triangles_;
  DividerStation divider_;
  std::array<std::size_t, 4> halves_;  ///< of det and num, among the triangle unit's results
  std::size_t hit_;
  std::vector<Slot> slots_;
};

inline hls::MajorBits box_format(const ref::IntScene& scene, const VerilatedDesign& boxes) {
  const Unit& unit = boxes.unit();
  if (!(unit.design->kind == hls::box_kind) ||
      &unit.format.family() != &rtl::Format(hls::MajorBits{}).family())
    throw std::runtime_error(
        fmt::format("design {}: no unit for boxes of the integer world", unit.design->name));
  const auto bits = unit.format.as<hls::MajorBits>();
  const hls::WorldBits& world = scene.bits;
  if (bits.coord != world.coord || bits.finer != world.finer || bits.slope != world.slope ||
      bits.fraction > world.finer + world.fraction)
    throw std::runtime_error(fmt::format(
        "boxes of {} for triangles of {}: n, g and S must be equal, and the f of boxes at most g + t",
        rtl::to_string(unit.format), rtl::to_string(rtl::Format(world))));
  return bits;
}

}  // namespace world_units

struct WorldTracer::Shared {
  world_units::Scene scene;
  WorldUnits units;
  std::unique_ptr<ref::Tracer> reference;
  mutable oneapi::tbb::enumerable_thread_specific<std::unique_ptr<world_units::Stations>> stations;
  mutable std::mutex counting;
  mutable WorldCounts counts;
};

WorldUnitCounts& WorldUnitCounts::operator+=(const WorldUnitCounts& other) {
  tests += other.tests;
  hits += other.hits;
  cycles += other.cycles;
  rtl_mismatches += other.rtl_mismatches;
  return *this;
}

WorldCounts& WorldCounts::operator+=(const WorldCounts& other) {
  boxes += other.boxes;
  triangles += other.triangles;
  divisions += other.divisions;
  rays += other.rays;
  different += other.different;
  reference += other.reference;
  return *this;
}

WorldTracer::WorldTracer(const ref::IntScene& scene, const WorldUnits& units)
    : shared_(std::make_unique<Shared>()) {
  if (units.rays_in_flight < 1 || units.rays_in_flight > world_units::most_in_flight)
    throw std::invalid_argument(fmt::format("{} rays in flight: allowed is 1 to {}", units.rays_in_flight,
                                            world_units::most_in_flight));
  shared_->scene = {&scene, {}, world_units::box_format(scene, *units.boxes), nullptr};
  if (scene.bvh) shared_->scene.boxes = ref::int_boxes(scene.mesh, *scene.bvh);
  shared_->units = units;
  shared_->scene.divider = std::make_unique<VerilatedMachine>(*rtl::machine_called(world_units::divider_name),
                                                              world_units::divider_format(scene.bits));
  shared_->reference = ref::int_tracer(scene.mesh, scene.hierarchy(), {.world = scene.bits});
}

WorldTracer::~WorldTracer() = default;

void WorldTracer::trace(const ref::TraceJob& job, ref::TraceCounts& counts) const {
  ref::check_places(job);
  std::vector<std::uint32_t> exact(job.rays.size());
  ref::TraceCounts reference;
  shared_->reference->trace({job.rays, job.query, exact}, reference);
  WorldCounts made{.boxes = {},
                   .triangles = {},
                   .divisions = {},
                   .rays = job.rays.size(),
                   .different = 0,
                   .reference = reference};
  if (!shared_->scene.scene->bvh) {
    std::fill(job.triangles.begin(), job.triangles.end(), ref::IntHit::none);
  } else {
    std::unique_ptr<world_units::Stations>& own = shared_->stations.local();
    if (!own) own = std::make_unique<world_units::Stations>(shared_->scene, shared_->units);
    own->run(job, counts);
  }
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const bool same = job.query == ref::Query::any
                          ? (job.triangles[i] == ref::IntHit::none) == (exact[i] == ref::IntHit::none)
                          : job.triangles[i] == exact[i];
    made.different += same ? 0 : 1;
  }
  const std::scoped_lock lock(shared_->counting);
  shared_->counts += made;
}

std::size_t WorldTracer::bytes_per_node() const {
  return shared_->reference->bytes_per_node();
}

std::size_t WorldTracer::node_count() const {
  return shared_->reference->node_count();
}

WorldCounts WorldTracer::counts() const {
  WorldCounts sum = shared_->counts;
  for (const auto& own : shared_->stations) {
    sum.boxes += own->boxes();
    sum.triangles += own->triangles();
    sum.divisions += own->divisions();
  }
  return sum;
}

}  // namespace hitpipe::sim
