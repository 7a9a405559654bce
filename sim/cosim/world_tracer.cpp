#include "sim/cosim/world_tracer.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "host/per_thread.hpp"
#include "rays/trace/int_tracer.hpp"
#include "rays/trace/leaf.hpp"
#include "sim/cosim/counts.hpp"
#include "sim/cosim/divider_station.hpp"
#include "sim/cosim/run_rays.hpp"
#include "sim/cosim/station.hpp"
#include "sim/cosim/world_boxes.hpp"
#include "sim/software/software.hpp"

namespace hitpipe::sim {

namespace world_units {

/// The units of one thread.
class Stations {
 public:
  virtual ~Stations() = default;
  virtual void run(const ref::TraceJob& job, ref::TraceCounts& counts) = 0;
  /// Of the stations.
  [[nodiscard]] virtual WorldCounts counts() const = 0;
};

template <class Boxes>
class StationsWith final : public Stations {
 public:
  StationsWith(const WorldBoxes& world, const WorldUnits& units, const VerilatedMachine& divider)
      : boxes_(*units.boxes, {evaluate(*units.boxes)}, units.rays_in_flight),
        triangles_(*units.triangles, {evaluate(*units.triangles)}, units.rays_in_flight),
        divider_(divider, divider_format(world.scene->bits)),
        hit_(rtl::place_of_hit(units.triangles->results())),
        halves_(places_of_halves(units.triangles->results())),
        world_(world) {
    for (int i = 0; i < units.rays_in_flight; ++i) places_.emplace_back(world, units);
  }

  void run(const ref::TraceJob& job, ref::TraceCounts& counts) override {
    std::size_t given = 0;
    query_ = job.query;
    rays_ = job.rays;
    run_rays(
        *this, places_.size(),
        [&] { return given < job.rays.size() ? std::optional(given++) : std::nullopt; },
        [&](std::size_t place) {
          const auto& walk = places_[place].boxes.walk();
          const std::size_t ray = places_[place].ray;
          job.triangles[ray] = walk.hit().triangle;
          if (!job.work.empty()) job.work[ray] = walk.counts();
          counts += walk.counts();
        });
  }

  // For run_rays().
  void start(std::size_t place, std::size_t ray) {
    const ref::IntRay made = ref::int_ray(rays_[ray], world_.scene->bits);
    places_[place].ray = ray;
    places_[place].boxes.start(made, query_);
    places_[place].triangle->start(made);
  }
  [[nodiscard]] bool done(std::size_t place) const { return walk(place).done(); }
  [[nodiscard]] bool idle() const { return boxes_.idle() && triangles_.idle() && divider_.idle(); }
  void ask(std::size_t place) {
    if (walk(place).at_triangle())
      triangles_.ask(place);
    else
      boxes_.ask(place);
  }
  template <class Answered>
  void cycle(const Answered& answered) {
    if (!boxes_.idle())
      boxes_.cycle(write_boxes(), [&](std::size_t place, const std::int64_t* results) {
        box_hits_ += places_[place].boxes.answer(results);
        answered(place);
      });
    if (!triangles_.idle())
      triangles_.cycle(write_triangle(), [&](std::size_t place, const std::int64_t* results) {
        Place& at = places_[place];
        if (results[hit_] == 0) {
          at.boxes.answer_triangle(false, 0);
          answered(place);
          return;
        }
        ++triangle_hits_;
        at.crossing = at.triangle->crossing(results);
        std::array<std::int64_t, 4> halves;
        for (std::size_t i = 0; i < halves.size(); ++i) halves[i] = results[halves_[i]];
        divider_.ask(static_cast<std::uint32_t>(place), halves);
      });
    if (!divider_.idle())
      divider_.cycle(
          [&](std::uint32_t place) { return best_of(walk(place)); },
          [&](std::uint32_t place, std::int64_t t, bool closer) {
            Place& at = places_[place];
            if (closer != is_closer(walk(place), at.crossing) || (at.crossing && at.crossing->t != t))
              ++divider_.counts().rtl_mismatches;
            at.boxes.answer_triangle(closer, t);
            answered(place);
          });
  }

  [[nodiscard]] WorldCounts counts() const override {
    WorldCounts counts;
    counts.boxes = boxes_.counts();
    counts.boxes.hits = box_hits_;
    counts.triangles = triangles_.counts();
    counts.triangles.hits = triangle_hits_;
    counts.divisions = divider_.counts();
    return counts;
  }

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

  static rtl::Evaluate evaluate(const VerilatedDesign& design) {
    return design.unit().design->evaluate(design.unit().format);
  }

  struct Place {
    Place(const WorldBoxes& world, const WorldUnits& units)
        : boxes(world, units.boxes->results()),
          triangle(make_triangle_test(*units.triangles->unit().design, units.triangles->unit().format)) {}

    std::size_t ray = 0;  ///< its place in the job
    Boxes boxes;
    std::unique_ptr<TriangleTest> triangle;
    std::optional<ref::IntCrossing> crossing{};  ///< of the test that is in the divider
  };

  [[nodiscard]] const auto& walk(std::size_t place) const { return places_[place].boxes.walk(); }
  [[nodiscard]] auto write_boxes() {
    return [this](std::size_t place, std::int64_t* out) { places_[place].boxes.write(out); };
  }
  [[nodiscard]] auto write_triangle() {
    return [this](std::size_t place, std::int64_t* out) {
      places_[place].triangle->operands(world_.scene->mesh.triangles[walk(place).triangle()], out);
    };
  }

  Station boxes_, triangles_;
  DividerStation divider_;
  std::size_t hit_;                    ///< of a triangle
  std::array<std::size_t, 4> halves_;  ///< of det and num, among the triangle unit's results
  const WorldBoxes& world_;
  std::vector<Place> places_;
  ref::Query query_ = ref::Query::closest;
  std::span<const ref::Ray> rays_;
  std::uint64_t box_hits_ = 0, triangle_hits_ = 0;
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
  const rtl::Unit& unit = boxes.unit();
  if (!(unit.design->kind == hls::box_kind || unit.design->kind == hls::pair_kind) ||
      &unit.format.family() != &Format(hls::MajorBits{}).family())
    throw std::runtime_error(
        fmt::format("design {}: no unit for boxes of the integer world", unit.design->name));
  const auto bits = unit.format.as<hls::MajorBits>();
  const hls::WorldBits& world = scene.bits;
  if (bits.coord != world.coord || bits.finer != world.finer || bits.slope != world.slope ||
      bits.fraction > world.finer + world.fraction)
    throw std::runtime_error(fmt::format(
        "boxes of {} for triangles of {}: n, g and S must be equal, and the f of boxes at most g + t",
        to_string(unit.format), to_string(Format(world))));
  return bits;
}

}  // namespace world_units

struct WorldTracer::Shared {
  WorldBoxes world;
  WorldUnits units;
  std::unique_ptr<const VerilatedMachine> divider;
  std::unique_ptr<ref::Tracer> reference;
  /// Units keep state from ray to ray.
  mutable host::PerThread<std::unique_ptr<world_units::Stations>> stations{
      [this] { return world_units::make_stations(world, units, *divider); }};
  mutable std::mutex counting;
  mutable WorldCounts counts;
};

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
  Station::check(units.rays_in_flight);
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
    shared_->stations.local()->run(job, counts);
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
  shared_->stations.for_each([&](const auto& own) { sum += own->counts(); });
  return sum;
}

}  // namespace hitpipe::sim
