#include "sim/check/stiffness.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "host/parallel.hpp"
#include "host/per_thread.hpp"
#include "rays/exact/box_referee.hpp"
#include "rays/trace/slabs.hpp"
#include "sim/cosim/walk.hpp"
#include "sim/software/feed.hpp"
#include "sw_ref/trace/traversal.hpp"

namespace hitpipe::sim {

using ref::adversary::Random;

namespace {

constexpr std::array half_sides{1, 4, 7};
constexpr std::size_t kinds = 2 * half_sides.size();

double percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

Random stream(std::uint64_t seed, std::size_t number) {
  return Random(seed + ref::golden_step * (number + 1));
}

glm::vec3 anywhere(Random& random) {
  glm::vec3 point;
  for (int axis = 0; axis < 3; ++axis) point[axis] = random.signed_unit();
  return point;
}

float within_cube(float x) {
  return std::clamp(x, -1.0F, 1.0F);
}

bool in_cube(const glm::vec3& point) {
  return std::abs(point.x) <= 1.0F && std::abs(point.y) <= 1.0F && std::abs(point.z) <= 1.0F;
}

/// Draws a ray and a box of the kind that `sum` names. Draws again if the ray would start outside the cube. A
/// ray moved onto the cube could start in the plane of a box that the cube cuts off.
void draw(Random& random, const StiffBoxes& sum, ref::Ray& ray, ref::Aabb& box) {
  do {
    ray.direction = stiff_direction(random, sum.stiffness);
    ray.origin = anywhere(random);
    const glm::vec3 middle = anywhere(random);
    const float away = 0.25F + 0.25F * random.signed_unit();
    for (int axis = 0; axis < 3; ++axis) {
      const float half = std::ldexp(0.75F + 0.25F * random.signed_unit(), -sum.half_side);
      box.min[axis] = within_cube(middle[axis] - half);
      box.max[axis] = within_cube(middle[axis] + half);
      const float target = middle[axis] + 2 * half * random.signed_unit();
      if (sum.aimed) ray.origin[axis] = target - away * ray.direction[axis];
    }
  } while (!in_cube(ray.origin));
}

void judge(BoxTest& test, Random random, std::uint64_t tests, StiffBoxes& sum) {
  for (; sum.tests < tests; ++sum.tests) {
    ref::Ray ray;
    ref::Aabb box;
    draw(random, sum, ray, box);
    test.start(ray);
    const bool hit = test.hit(box);
    const bool meets = test.meets(ray, box);
    sum.hits += meets ? 1 : 0;
    sum.false_hits += hit && !meets ? 1 : 0;
    sum.false_misses += meets && !hit ? 1 : 0;
  }
}

}  // namespace

std::span<const Stiffness> stiffnesses() {
  static constexpr auto table = [] {
    std::array<Stiffness, 22> made{};
    for (std::size_t i = 0; i + 1 < made.size(); ++i) made[i] = 2 * static_cast<int>(i);
    return made;
  }();
  return table;
}

glm::vec3 stiff_direction(Random& random, Stiffness stiffness) {
  glm::vec3 direction;
  for (int axis = 0; axis < 3; ++axis) direction[axis] = random.of_exponent(0, 0);
  float& small = direction[random.axis()];
  small = stiffness ? std::ldexp(small, -*stiffness) : std::copysign(0.0F, small);
  return direction;
}

double StiffBoxes::false_hit_pct() const {
  return percent(false_hits, tests - hits);
}

ref::Interval StiffBoxes::false_hit_pct_interval() const {
  const ref::Interval share = ref::wilson_interval(false_hits, tests - hits);
  return {100.0 * share.low, 100.0 * share.high};
}

double StiffTraversals::extra_box_tests_pct() const {
  return percent(box_tests, reference_box_tests) - 100.0;
}

ref::Interval StiffTraversals::extra_box_tests_pct_interval() const {
  const ref::Interval ratio = work.interval();
  return {100.0 * (ratio.low - 1.0), 100.0 * (ratio.high - 1.0)};
}

std::vector<StiffBoxes> stiff_boxes(const MakeBoxTest& make, const StiffnessOptions& options) {
  std::vector<StiffBoxes> sums;
  for (const Stiffness stiffness : stiffnesses()) {
    for (const int half_side : half_sides) {
      for (const bool aimed : {true, false}) {
        sums.push_back({.stiffness = stiffness, .half_side = half_side, .aimed = aimed});
      }
    }
  }
  // When the tests cannot be divided evenly, the first kinds of each stiffness get one more.
  const auto share = [&](std::size_t i) {
    return options.tests / kinds + (i % kinds < options.tests % kinds ? 1 : 0);
  };
  host::PerThread<std::unique_ptr<BoxTest>> workers(make);
  const auto judge_kind = [&](std::size_t i) {
    judge(*workers.local(), stream(options.seed, i), share(i), sums[i]);
  };
  host::for_each_index(sums.size(), options.threads, judge_kind, options.progress);
  return sums;
}

std::vector<StiffBoxes> over_all_kinds(const std::vector<StiffBoxes>& boxes) {
  std::vector<StiffBoxes> sums;
  for (const StiffBoxes& kind : boxes) {
    if (sums.empty() || sums.back().stiffness != kind.stiffness) {
      sums.push_back({.stiffness = kind.stiffness});
    }
    sums.back().tests += kind.tests;
    sums.back().hits += kind.hits;
    sums.back().false_hits += kind.false_hits;
    sums.back().false_misses += kind.false_misses;
  }
  return sums;
}

std::vector<StiffTraversals> stiff_traversals(const rtl::Design& design, Format format, const ref::Mesh& mesh,
                                              const ref::Bvh& bvh, const StiffnessOptions& options) {
  const std::unique_ptr<SceneFeed> feed = make_feed(design, format, bvh);
  const rtl::Evaluate evaluate = design.evaluate(format);
  const std::size_t ports = design.ports(format).size();
  std::vector<StiffTraversals> sums;
  for (const Stiffness stiffness : stiffnesses()) sums.push_back({.stiffness = stiffness});
  const std::vector<hls::Result> results = design.results(format);
  const auto traverse = [&](const auto& walk, std::size_t i) {
    StiffTraversals& sum = sums[i];
    Random random = stream(options.seed, i);
    const std::unique_ptr<RayFeed> unit = feed->unit(1);
    ref::TraceCounts reference;
    std::vector<std::int64_t> operands(ports);
    std::vector<std::int64_t> answers(results.size());
    for (; sum.rays < options.rays; ++sum.rays) {
      const glm::vec3 direction = stiff_direction(random, sum.stiffness);
      const ref::Ray ray{anywhere(random), direction, ref::Ray::infinite};
      auto traversal = walk.start(*unit, 0, ray, ref::Query::closest);
      while (!traversal.done()) {
        walk.ask(*unit, 0, traversal, operands.data());
        evaluate(operands.data(), answers.data());
        walk.answer(*unit, 0, traversal, answers.data());
      }
      const std::uint64_t box_tests = traversal.counts().box_tests;
      const std::uint64_t reference_before = reference.box_tests;
      sum.box_tests += box_tests;
      const ref::Hit hit = ref::trace<ref::ConservativeSlabs>(bvh, mesh, ray, ref::Query::closest, reference);
      sum.work.add(static_cast<double>(box_tests),
                   static_cast<double>(reference.box_tests - reference_before));
      sum.different_triangles += hit.triangle == traversal.hit().triangle ? 0 : 1;
    }
    sum.reference_box_tests = reference.box_tests;
  };
  with_walk({feed.get(), &bvh, &mesh}, results, [&](const auto& walk) {
    host::for_each_index(
        sums.size(), options.threads, [&](std::size_t i) { traverse(walk, i); }, options.progress);
  });
  return sums;
}

}  // namespace hitpipe::sim
