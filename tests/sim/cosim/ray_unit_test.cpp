// A unit answers every ray as a software traversal does, with any number of rays at once, and its counts
// match its answers.
#include "sim/cosim/ray_unit.hpp"

#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "rays/exact/box_referee.hpp"
#include "rays/trace/slabs.hpp"
#include "sw_ref/trace/traversal.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/units.hpp"

namespace hitpipe::sim::ray_unit_test {
namespace {

constexpr std::uint32_t ray_count = 2000;
constexpr unsigned seed = 41;

struct Outcome {
  UnitCounts counts;
  std::vector<std::uint32_t> triangles;  // by ray; for shadow rays 0 or Hit::none
  std::uint32_t ended = 0;
};

/// Units that never miss a box. Another may find another triangle.
std::vector<TestedUnit> conservative_units() {
  std::vector<TestedUnit> all = units_of_boxes();
  std::erase_if(all, [](const TestedUnit& unit) { return !unit.design().conservative; });
  return all;
}

class RayUnitOnHills : public testing::TestWithParam<TestedUnit> {
 protected:
  RayUnitOnHills() {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> coordinate(-0.9F, 0.9F);
    const auto point = [&] { return glm::vec3(coordinate(random), coordinate(random), coordinate(random)); };
    for (std::uint32_t id = 0; id < ray_count; ++id) {
      const glm::vec3 from = point();
      const glm::vec3 to = point();
      RayJob job{{from, to - from, ref::Ray::infinite}, ref::Query::closest, id};
      if (id % 3 == 0) job.query = ref::Query::any;
      if (id % 2 == 0) job.ray.length = 1.0F;
      if (id % 7 == 0) job.ray.direction[static_cast<int>(id % 3)] = 0.0F;
      jobs_.push_back(job);
    }
  }

  [[nodiscard]] Outcome run(int rays_in_flight, rtl::Evaluate evaluate, bool referee = true) const {
    RayUnit unit({.verilated = &verilated(GetParam()),
                  .evaluate = evaluate,
                  .feed = feed_.get(),
                  .bvh = &bvh_,
                  .mesh = &scene_.mesh,
                  .rays_in_flight = rays_in_flight,
                  .referee = referee});
    Outcome outcome;
    outcome.triangles.resize(jobs_.size());
    std::size_t given = 0;
    unit.run([&] { return given < jobs_.size() ? std::optional(jobs_[given++]) : std::nullopt; },
             [&](const RayJob& job, const RayAnswer& answer) {
               ++outcome.ended;
               const bool only_blocked = job.query == ref::Query::any && answer.hit.found();
               outcome.triangles[job.id] = only_blocked ? 0 : answer.hit.triangle;
             });
    outcome.counts = unit.counts();
    return outcome;
  }

  [[nodiscard]] std::vector<std::uint32_t> software() const {
    std::vector<std::uint32_t> triangles;
    ref::TraceCounts counts;
    for (const RayJob& job : jobs_) {
      const ref::Hit hit = ref::trace<ref::ConservativeSlabs>(bvh_, scene_.mesh, job.ray, job.query, counts);
      triangles.push_back(job.query == ref::Query::any && hit.found() ? 0 : hit.triangle);
    }
    return triangles;
  }

  [[nodiscard]] rtl::Evaluate datapath() const { return GetParam().evaluate(); }

  const ref::Scene scene_ = hills();
  const ref::Bvh bvh_ = ref::build_bvh(scene_.mesh);
  const std::unique_ptr<SceneFeed> feed_ = make_feed(GetParam().design(), GetParam().format, bvh_);
  std::vector<RayJob> jobs_;
};

TEST_P(RayUnitOnHills, FindsWhatSoftwareFinds) {
  const Outcome outcome = run(32, datapath());
  EXPECT_EQ(outcome.triangles, software());
  EXPECT_EQ(outcome.ended, ray_count);
  EXPECT_EQ(outcome.counts.rtl_mismatches, 0U);
  EXPECT_EQ(outcome.counts.false_misses, 0U);
  EXPECT_GT(outcome.counts.box_tests, 5 * ray_count);
  EXPECT_GT(outcome.counts.hits, ray_count / 2);
  EXPECT_LT(outcome.counts.hits, outcome.counts.box_tests);
  EXPECT_LE(outcome.counts.false_hits, outcome.counts.hits);
  EXPECT_GT(outcome.counts.triangle_tests, 0U);
}

/// The same rays steered by the C++ datapath, without cycles, and judged here.
TEST_P(RayUnitOnHills, CountsWhatTheDatapathSays) {
  UnitCounts expected = UnitCounts::zeros(true);
  const auto rays = feed_->unit(1);
  std::vector<std::int64_t> operands(verilated(GetParam()).operand_count());
  const std::vector<hls::Result> results = GetParam().design().results(GetParam().format);
  std::vector<std::int64_t> answers(results.size());
  with_walk({feed_.get(), &bvh_, &scene_.mesh}, results, [&](const auto& walk) {
    for (const RayJob& job : jobs_) {
      auto traversal = walk.start(*rays, 0, job.ray, job.query);
      while (!traversal.done()) {
        walk.ask(*rays, 0, traversal, operands.data());
        datapath()(operands.data(), answers.data());
        ref::Ray cut = job.ray;
        cut.length = traversal.length();
        ++expected.tests;
        ++expected.bit_level_tests;
        walk.each_box(traversal, answers.data(), [&](const ref::Aabb& box, bool hit) {
          const bool meets = ref::ray_meets_box_exact(cut, box);
          ++expected.box_tests;
          expected.hits += hit ? 1 : 0;
          *expected.false_hits += hit && !meets ? 1 : 0;
          *expected.false_misses += !hit && meets ? 1 : 0;
        });
        walk.answer(*rays, 0, traversal, answers.data());
      }
      expected.triangle_tests += traversal.counts().triangle_tests;
    }
  });
  const Outcome outcome = run(32, datapath());
  expected.cycles = outcome.counts.cycles;
  EXPECT_EQ(outcome.counts, expected);
  EXPECT_EQ(expected.false_misses, 0U);
}

TEST_P(RayUnitOnHills, OneRayInFlightWaitsForEachAnswer) {
  const Outcome outcome = run(1, datapath());
  // A box is sent in one cycle. Its answer is latched `latency` edges after the edge that took it, and seen
  // in the next cycle. The next box is sent in the cycle after that.
  const auto cycles_per_test = static_cast<std::uint64_t>(verilated(GetParam()).latency()) + 2;
  EXPECT_EQ(outcome.counts.cycles, outcome.counts.tests * cycles_per_test);
}

TEST_P(RayUnitOnHills, OnlyCyclesDependOnRaysInFlight) {
  const Outcome one = run(1, datapath());
  std::uint64_t cycles = one.counts.cycles;
  for (const int rays_in_flight : {2, 5, 32, 1500}) {
    Outcome many = run(rays_in_flight, datapath());
    EXPECT_LT(many.counts.cycles, cycles) << rays_in_flight;
    EXPECT_GE(many.counts.cycles, many.counts.tests) << rays_in_flight;
    cycles = many.counts.cycles;
    EXPECT_EQ(many.triangles, one.triangles) << rays_in_flight;
    many.counts.cycles = one.counts.cycles;
    EXPECT_EQ(many.counts, one.counts) << rays_in_flight;
  }
}

TEST_P(RayUnitOnHills, RefereeOnlyAddsItsCounts) {
  UnitCounts judged = run(32, datapath(), true).counts;
  const UnitCounts unjudged = run(32, datapath(), false).counts;
  EXPECT_EQ(unjudged.false_hits, std::nullopt);
  EXPECT_EQ(unjudged.false_misses, std::nullopt);
  judged.false_hits.reset();
  judged.false_misses.reset();
  EXPECT_EQ(judged, unjudged);
}

TEST_P(RayUnitOnHills, EveryAnswerIsComparedWithTheDatapath) {
  if (verilated(GetParam()).results().size() > 1) return;  // of the answers below HIT is all
  const auto answering = [](rtl::Evaluate::Run answer) {
    return rtl::Evaluate(answer, GetParam().format, GetParam().design().results(GetParam().format));
  };
  using Operands = const std::int64_t*;
  const rtl::Evaluate always =
      answering([](const Format&, Operands, std::int64_t* results) { *results = 1; });
  const rtl::Evaluate never = answering([](const Format&, Operands, std::int64_t* results) { *results = 0; });
  const Outcome outcome = run(32, datapath());
  EXPECT_EQ(run(32, always).counts.rtl_mismatches, outcome.counts.box_tests - outcome.counts.hits);
  const Outcome against_never = run(32, never);
  EXPECT_EQ(against_never.counts.rtl_mismatches, outcome.counts.hits);
  // The Verilog steers the rays, whatever it is compared with.
  EXPECT_EQ(against_never.triangles, outcome.triangles);
}

TEST_P(RayUnitOnHills, NoRaysTakeNoCycle) {
  jobs_.clear();
  const Outcome outcome = run(32, datapath());
  EXPECT_EQ(outcome.counts, UnitCounts::zeros(true));
}

/// With no rays in flight it would trace nothing, and nothing would be wrong.
TEST_P(RayUnitOnHills, NumberOfRaysInFlightThatATagCannotHoldIsRefused) {
  for (const int rays : {-1, 0, 65'537}) EXPECT_THROW((void)run(rays, datapath()), std::invalid_argument);
  EXPECT_EQ(run(65'536, datapath()).ended, ray_count);
}

/// The bit-level datapath judges the first test and every 61st after it, the other function all others.
TEST_P(RayUnitOnHills, ShareOfTheTestsIsComparedBitByBit) {
  using Operands = const std::int64_t*;
  const std::vector<hls::Result> results = GetParam().design().results(GetParam().format);
  const auto counts = [&](const rtl::Evaluate& bit_level, const rtl::Evaluate& on_float_unit) {
    RayUnit unit({.verilated = &verilated(GetParam()),
                  .evaluate = bit_level,
                  .on_float_unit = on_float_unit,
                  .feed = feed_.get(),
                  .bvh = &bvh_,
                  .mesh = &scene_.mesh,
                  .rays_in_flight = 32,
                  .referee = false});
    std::size_t given = 0;
    unit.run([&] { return given < jobs_.size() ? std::optional(jobs_[given++]) : std::nullopt; },
             [](const RayJob&, const RayAnswer&) {});
    return unit.counts();
  };
  // 2 is no answer of any Verilog.
  const rtl::Evaluate wrong([](const Format&, Operands, std::int64_t* out) { *out = 2; }, GetParam().format,
                            results);
  const UnitCounts wrong_bits = counts(wrong, datapath());
  EXPECT_EQ(wrong_bits.bit_level_tests, (wrong_bits.tests + 60) / 61);
  EXPECT_EQ(wrong_bits.rtl_mismatches, wrong_bits.bit_level_tests);
  const UnitCounts wrong_floats = counts(datapath(), wrong);
  EXPECT_EQ(wrong_floats.rtl_mismatches, wrong_floats.tests - wrong_floats.bit_level_tests);
}

INSTANTIATE_TEST_SUITE_P(Units, RayUnitOnHills, testing::ValuesIn(conservative_units()),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST(UnitCountsSum, AddsEveryField) {
  UnitCounts sum{1, 2, 3, 4, 5, 6, 7, 8, 9};
  sum += {10, 20, 30, 40, 50, 60, 70, 80, 90};
  EXPECT_EQ(sum, (UnitCounts{11, 22, 33, 44, 55, 66, 77, 88, 99}));
}

/// If one side did not count, the sum has no count.
TEST(UnitCountsSum, IsJudgedOnlyIfBothSidesAre) {
  UnitCounts sum = UnitCounts::zeros(true);
  sum += UnitCounts::zeros(false);
  EXPECT_EQ(sum, UnitCounts::zeros(false));
  sum += UnitCounts::zeros(true);
  EXPECT_EQ(sum, UnitCounts::zeros(false));
}

}  // namespace
}  // namespace hitpipe::sim::ray_unit_test
