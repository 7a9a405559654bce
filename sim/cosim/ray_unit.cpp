#include "sim/cosim/ray_unit.hpp"

#include <vector>

#include "rays/exact/box_referee.hpp"
#include "sim/cosim/run_rays.hpp"

namespace hitpipe::sim {

/// The rays in flight, for run_rays().
template <class Walk>
class RayUnit::World {
 public:
  World(RayUnit& unit, const Walk& walk)
      : unit_(unit), walk_(walk), places_(static_cast<std::size_t>(unit.options_.rays_in_flight)) {}

  void start(std::size_t place, const RayJob& job) {
    places_[place].job = job;
    places_[place].box_tests = 0;
    places_[place].walk.emplace(walk_.start(*unit_.rays_, place, job.ray, job.query));
  }
  [[nodiscard]] bool done(std::size_t place) const { return places_[place].walk->done(); }
  [[nodiscard]] bool idle() const { return unit_.station_.idle(); }
  [[nodiscard]] const RayJob& job(std::size_t place) const { return places_[place].job; }
  [[nodiscard]] RayAnswer answer(std::size_t place) const {
    const auto& walk = *places_[place].walk;
    return {walk.hit(), places_[place].box_tests, walk.counts().triangle_tests};
  }

  void ask(std::size_t place) { unit_.station_.ask(place); }
  template <class Answered>
  void cycle(const Answered& answered) {
    unit_.station_.cycle([&](std::size_t ray, std::int64_t* operands) { write(ray, operands); },
                         [&](std::size_t ray, const std::int64_t* results) {
                           judge(places_[ray], results);
                           walk_.answer(*unit_.rays_, ray, *places_[ray].walk, results);
                           answered(ray);
                         });
  }

 private:
  struct Place {
    RayJob job;
    std::uint64_t box_tests = 0;
    std::optional<typename Walk::Traversal> walk;
  };

  void write(std::size_t place, std::int64_t* operands) const {
    Walk::ask(*unit_.rays_, place, *places_[place].walk, operands);
  }
  void judge(Place& place, const std::int64_t* results) {
    UnitCounts& counts = unit_.judged_;
    walk_.each_box(*place.walk, results, [&](const ref::Aabb& box, bool hit) {
      ++counts.box_tests;
      ++place.box_tests;
      counts.hits += hit ? 1 : 0;
      if (!unit_.options_.referee) return;
      ref::Ray ray = place.job.ray;
      ray.length = place.walk->length();
      const bool meets = ref::ray_meets_box(ray, box);
      *counts.false_misses += meets && !hit ? 1 : 0;
      *counts.false_hits += !meets && hit ? 1 : 0;
    });
  }

  RayUnit& unit_;
  const Walk& walk_;
  std::vector<Place> places_;
};

RayUnit::RayUnit(const Options& options)
    : options_(options),
      station_(*options.verilated, {options.evaluate, options.on_float_unit}, options.rays_in_flight),
      rays_(options.feed->unit(static_cast<std::size_t>(options.rays_in_flight))),
      judged_(UnitCounts::zeros(options.referee)) {}

UnitCounts RayUnit::counts() const {
  UnitCounts counts = station_.counts();
  counts.false_misses = counts.false_hits = 0;  // those of the sum are there when both sides have them
  return counts += judged_;
}

void RayUnit::run(const std::function<std::optional<RayJob>()>& next,
                  const std::function<void(const RayJob&, const RayAnswer&)>& ended) {
  with_walk({options_.feed, options_.bvh, options_.mesh}, options_.verilated->results(),
            [&]<class Walk>(const Walk& walk) {
              World<Walk> world(*this, walk);
              run_rays(world, static_cast<std::size_t>(options_.rays_in_flight), next,
                       [&](std::size_t place) {
                         const RayAnswer answer = world.answer(place);
                         judged_.triangle_tests += answer.triangle_tests;
                         ended(world.job(place), answer);
                       });
            });
}

}  // namespace hitpipe::sim
