#include "sim/check/triangle_check.hpp"

#include <array>

#include "rays/world/crossing.hpp"
#include "sim/check/shares.hpp"
#include "sim/unit/drive.hpp"

namespace hitpipe::sim {

namespace {

bool same(const std::optional<ref::IntCrossing>& unit, const std::optional<ref::IntCrossing>& exact,
          bool has_weights) {
  if (unit.has_value() != exact.has_value()) return false;
  if (!exact) return true;
  return unit->t == exact->t && unit->det == exact->det && (!has_weights || unit->e == exact->e);
}

ref::IntRay without_an_end(ref::IntRay ray, const hls::WorldBits& world) {
  ray.length = world.largest_distance();
  return ray;
}

/// HIT is right.
bool same(const CrossingFlags& unit, const std::optional<ref::Crossing>& exact, int crossings) {
  if (!exact) return !unit.tie && !unit.once;
  return unit.side == exact->side && (crossings == 2 ? unit.once == exact->once : unit.tie == exact->tie);
}

TriangleCategoryResult judge_triangles(TriangleTest& test, const ref::IntCategory& category,
                                       std::uint64_t seed, std::uint64_t tests, Model* rtl) {
  ref::adversary::Random random(seed);
  const hls::WorldBits& world = test.world();
  std::vector<std::int64_t> operands(test.operand_count());
  std::array<std::int64_t, rtl::Evaluate::most_results> results{};
  TriangleCategoryResult result;
  result.category = category.name;
  TestBatch batch;
  while (result.tests < tests) {
    ref::IntCase c = category.make(random, world);
    if (random.below(4) == 0)
      c.ray.length = static_cast<std::int64_t>(random.bits() & static_cast<std::uint64_t>(c.ray.length));
    std::array<ref::IntTriangle, objects_per_ray> triangles;
    ref::int_neighbours(random, c.triangle, world, triangles);
    // The end of a ray is at a triangle, or one unit before it.
    if (random.below(4) == 0) {
      if (const auto crossing = ref::int_crossing(c.ray, c.triangle, world))
        c.ray.length = std::max<std::int64_t>(0, crossing->t - static_cast<std::int64_t>(random.below(2)));
    }
    test.start(c.ray);
    for (std::size_t i = 0; i < objects_per_ray && result.tests < tests; ++i, ++result.tests) {
      const auto exact = ref::int_crossing(c.ray, triangles[i], world);
      test.operands(triangles[i], operands.data());
      test.evaluate()(operands.data(), results.data());
      if (rtl != nullptr) batch.add(operands, std::span(results).first(test.evaluate().result_count()));
      result.hits += exact ? 1 : 0;
      bool right = same(test.crossing(results.data()), exact, world.weights != 0);
      if (world.crossings != 0) {
        const auto crossing = ref::crossing_of(without_an_end(c.ray, world), triangles[i], world);
        result.ties += exact && crossing->tie ? 1 : 0;
        result.counted += exact && crossing->tie && crossing->once ? 1 : 0;
        right = right && same(test.crossing_flags(results.data()), crossing, world.crossings);
      }
      if (right) continue;
      ++result.wrong;
      if (!result.first_wrong) result.first_wrong = ref::IntCase{c.ray, triangles[i]};
    }
  }
  if (rtl != nullptr) result.rtl_mismatches = drive(*rtl, batch).faults();
  return result;
}

}  // namespace

TriangleCategoryResult& TriangleCategoryResult::operator+=(const TriangleCategoryResult& later) {
  tests += later.tests;
  hits += later.hits;
  ties += later.ties;
  counted += later.counted;
  wrong += later.wrong;
  rtl_mismatches += later.rtl_mismatches;
  if (!first_wrong) first_wrong = later.first_wrong;
  return *this;
}

std::vector<TriangleCategoryResult> check_triangles(const MakeTriangleTest& make,
                                                    const TriangleCheckOptions& options) {
  return judge_by_category<TriangleCategoryResult>(options, make, judge_triangles,
                                                   &TriangleCategoryResult::first_wrong);
}

}  // namespace hitpipe::sim
