#include "sim/cosim/world_tracer.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/enumerable_thread_specific.h>

#include "sim/cosim/counts.hpp"
#include "sim/cosim/divider_station.hpp"
#include "sim/cosim/world_boxes.hpp"
#include "sim/software.hpp"
#include "sw_ref/trace/leaf_test.hpp"
#include "sw_ref/world/int_tracer.hpp"

namespace hitpipe::sim {

namespace world_units {

constexpr int most_in_flight = 65'536;  // a tag has 16 bits

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
  [[nodiscard]] const WorldUnitCounts& counts() const { return counts_; }

  /// One cycle. write(ray, operands) gives the operands of the next ray's test; answered(ray, results) takes
  /// an answer and returns how many objects are hit.
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
    counts_.rtl_mismatches += same ? 0 : 1;
    counts_.hits += answered(sent.ray, results_.data());
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

/// The units of one thread.
class Stations {
 public:
  virtual ~Stations() = default;
  virtual void run(const ref::TraceJob& job, ref::TraceCounts& counts) = 0;
  [[nodiscard]] virtual const WorldUnitCounts& boxes() const = 0;
  [[nodiscard]] virtual const WorldUnitCounts& triangles() const = 0;
  [[nodiscard]] virtual const WorldUnitCounts& divisions() const = 0;
};

template <class Boxes>
class StationsWith final : public Stations {
 public:
  StationsWith(const WorldBoxes& world, const WorldUnits& units, const VerilatedMachine& divider)
      : boxes_(*units.boxes, evaluate(*units.boxes)),
        triangles_(*units.triangles, evaluate(*units.triangles)),
        divider_(divider, divider_format(world.scene->bits)),
        hit_(rtl::place_of_hit(units.triangles->results())),
        halves_(places_of_halves(units.triangles->results())),
        world_(world) {
    for (int i = 0; i < units.rays_in_flight; ++i) slots_.emplace_back(world, units);
  }

  void run(const ref::TraceJob& job, ref::TraceCounts& counts) override {
    std::size_t next = 0, ended = 0;
    for (Slot& slot : slots_) slot.ray = none;
    const auto start = [&](Slot& slot) {
      const ref::IntRay made = ref::int_ray(job.rays[next], world_.scene->bits);
      slot.ray = next++;
      slot.boxes.start(made, job.query);
      slot.triangle->start(made);
    };
    const auto step = [&](std::uint32_t number) {
      Slot& slot = slots_[number];
      while (slot.ray != none && slot.walk().done()) {
        job.triangles[slot.ray] = slot.walk().hit().triangle;
        const ref::TraceCounts work = slot.walk().counts();
        if (!job.work.empty()) job.work[slot.ray] = work;
        counts += work;
        ++ended;
        slot.ray = none;
        if (next < job.rays.size()) start(slot);
      }
      if (slot.ray != none) (slot.walk().at_triangle() ? triangles_ : boxes_).ask(number);
    };
    for (std::uint32_t i = 0; i < slots_.size() && next < job.rays.size(); ++i) {
      start(slots_[i]);
      step(i);
    }
    while (ended < job.rays.size()) {
      if (!boxes_.idle())
        boxes_.cycle([&](std::uint32_t ray, std::int64_t* out) { slots_[ray].boxes.write(out); },
                     [&](std::uint32_t ray, const std::int64_t* results) {
                       const unsigned hits = slots_[ray].boxes.answer(results);
                       step(ray);
                       return hits;
                     });
      if (!triangles_.idle())
        triangles_.cycle(
            [&](std::uint32_t ray, std::int64_t* out) {
              Slot& slot = slots_[ray];
              slot.triangle->operands(world_.scene->mesh.triangles[slot.walk().triangle()], out);
            },
            [&](std::uint32_t ray, const std::int64_t* results) {
              Slot& slot = slots_[ray];
              if (results[hit_] == 0) {
                slot.walk().answer_triangle(false, 0);
                step(ray);
                return 0U;
              }
              slot.crossing = slot.triangle->crossing(results);
              std::array<std::int64_t, 4> halves;
              for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = results[halves_[i]];
              divider_.ask(ray, halves);
              return 1U;
            });
      if (!divider_.idle())
        divider_.cycle(
            [&](std::uint32_t ray) { return best_of(slots_[ray].walk()); },
            [&](std::uint32_t ray, std::int64_t t, bool closer) {
              Slot& slot = slots_[ray];
              if (closer != is_closer(slot.walk(), slot.crossing) || (slot.crossing && slot.crossing->t != t))
                ++divider_.counts().rtl_mismatches;
              slot.walk().answer_triangle(closer, t);
              step(ray);
            });
    }
  }

  [[nodiscard]] const WorldUnitCounts& boxes() const override { return boxes_.counts(); }
  [[nodiscard]] const WorldUnitCounts& triangles() const override { return triangles_.counts(); }
  [[nodiscard]] const WorldUnitCounts& divisions() const override { return divider_.counts(); }

 private:
  template <class Walk>
  static BestHit best_of(const Walk& walk) {
    if (walk.done()) return {0, 0, 0};  // of an earlier test
    return {walk.at_triangle() ? walk.triangle() : 0, walk.length(),
            walk.hit().found() ? walk.hit().triangle : ref::IntHit::none};
  }
  /// What exact integers say; a crossing beyond the ray's length is none.
  template <class Walk>
  static bool is_closer(const Walk& walk, const std::optional<ref::IntCrossing>& crossing) {
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
    Slot(const WorldBoxes& world, const WorldUnits& units)
        : boxes(world, units.boxes->results()),
          triangle(make_triangle_test(*units.triangles->unit().design, units.triangles->unit().format)) {}
    [[nodiscard]] auto& walk() { return boxes.walk(); }

    std::size_t ray = none;  ///< its place in the job
    Boxes boxes;
    std::unique_ptr<TriangleTest> triangle;
    std::optional<ref::IntCrossing> crossing{};  ///< of the test that is in the divider
  };

  Station boxes_, triangles_;
  DividerStation divider_;
  std::size_t hit_;                    ///< of a triangle
  std::array<std::size_t, 4> halves_;  ///< of det and num, among the triangle unit's results
  const WorldBoxes& world_;
  std::vector<Slot> slots_;
};

inline bool tests_two(const WorldUnits& units) {
  return units.boxes->unit().design->kind == hls::pair_kind;
}

inline std::unique_ptr<Stations> make_stations(const WorldBoxes& world, const WorldUnits& units,
                                               const VerilatedMachine& divider) {
  if (tests_two(units)) return std::make_unique<StationsWith<TwoBoxesOfWorld>>(world, units, divider);
  return std::make_unique<StationsWith<OneBoxOfWorld>>(world, units, divider);
}

inline hls::MajorBits box_format(const ref::IntScene& scene, const VerilatedDesign& boxes) {
  const Unit& unit = boxes.unit();
  if (!(unit.design->kind == hls::box_kind || unit.design->kind == hls::pair_kind) ||
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
  WorldBoxes world;
  WorldUnits units;
  std::unique_ptr<const VerilatedMachine> divider;
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
  shared_->world = {scene, world_units::box_format(scene, *units.boxes)};
  shared_->units = units;
  shared_->divider = std::make_unique<const VerilatedMachine>(*rtl::machine_called(divider_name),
                                                              divider_format(scene.bits));
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
  if (!shared_->world.scene->bvh) {
    std::fill(job.triangles.begin(), job.triangles.end(), ref::IntHit::none);
  } else {
    std::unique_ptr<world_units::Stations>& own = shared_->stations.local();
    if (!own) own = world_units::make_stations(shared_->world, shared_->units, *shared_->divider);
    own->run(job, counts);
  }
  for (std::size_t i = 0; i < exact.size(); ++i) {
    made.different += ref::same_answer(job.query, job.triangles[i], exact[i]) ? 0 : 1;
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
