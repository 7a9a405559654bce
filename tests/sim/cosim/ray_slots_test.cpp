// Units behind ray slots answer as the C++ datapath does for the ray that a slot held, whatever is written
// meanwhile, and trace whole scenes. Damaged wrappers are found.
#include <gtest/gtest.h>

#include "rtl_gen/emit/vectors.hpp"
#include "sim/cosim/cosim.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/adversary_vectors.hpp"
#include "tests/sim/cosim/slot_traffic.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/units.hpp"

namespace hitpipe::sim::ray_slots_test {
namespace {

constexpr std::uint64_t seed = 97;
constexpr int few_slots = 4;  // so that a write often meets a test of its slot

const TestedUnit slabs{"int_slabs", hls::IntBits{12, 12}};
const TestedUnit pair{"int_major_pair", hls::MajorBits{12, 1, 12, 0}};

/// With `good` in its Verilog replaced by `bad`.
VerilatedDesign behind_slots(const TestedUnit& tested, int slots, const std::string& good = "",
                             const std::string& bad = "") {
  const rtl::Unit unit = rtl::make_unit(tested.design(), tested.format, rtl::Library::thesis());
  return VerilatedDesign(damaged(rtl::behind_ray_slots(unit, slots), good, bad));
}

std::vector<std::vector<std::int64_t>> vectors_of(const TestedUnit& unit) {
  std::vector<std::vector<std::int64_t>> all;
  for (const auto& category : ref::adversary::categories()) {
    const auto some = adversary_vectors(unit, category, 200, seed);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

SlotReport driven(const TestedUnit& unit, const VerilatedDesign& design, std::uint64_t tests = 30'000) {
  return slot_traffic(design, unit.evaluate(), vectors_of(unit), tests, seed);
}

class RaySlotsOf : public testing::TestWithParam<TestedUnit> {};

TEST_P(RaySlotsOf, AnswerForTheRayThatTheSlotHeld) {
  const VerilatedDesign design = behind_slots(GetParam(), few_slots);
  EXPECT_EQ(design.latency(), verilated(GetParam()).latency() + 1);
  const SlotReport report = driven(GetParam(), design);
  EXPECT_EQ(report.received, 30'000U);
  EXPECT_EQ(report.wrong_answers, 0U);
  EXPECT_EQ(report.beside_write, 0U);
  EXPECT_EQ(report.faults(), 0U);
  // The hazards did occur.
  EXPECT_GT(report.waited_for_write, 1000U);
  EXPECT_GT(report.under_way, 3000U);
  EXPECT_GT(report.resets, 100U);
  EXPECT_GT(report.hits, report.received / 50);
  EXPECT_EQ(report.ends > 1000, !design.unit().ray_slots->end.empty());
}

TEST_P(RaySlotsOf, TraceScenesWithRaysWrittenBesideTests) {
  const VerilatedDesign design = behind_slots(GetParam(), 32);
  const VerilatedDesign& bare = verilated(GetParam());
  for (const ref::Scene& scene : {hills(), ref::load_scene("spheres")}) {
    const ref::Bvh bvh = ref::build_bvh(scene.mesh);
    const CosimOptions options{
        .width = 40, .height = 40, .rays_in_flight = 32, .threads = 2, .referee = true};
    const CosimResult result = cosimulate(design, scene, bvh, options);
    EXPECT_TRUE(result.verified(true)) << scene.name;
    EXPECT_EQ(result.unit.rtl_mismatches, 0U);
    EXPECT_EQ(result.unit.false_misses, 0U);
    const std::uint64_t rays =
        result.rays_primary + result.rays_secondary + result.rays_shadow - result.rejected;
    EXPECT_EQ(result.unit.ray_writes, rays);
    EXPECT_EQ(result.unit.end_writes > 0, !design.unit().ray_slots->end.empty());
    EXPECT_LT(result.unit.cycles, result.unit.tests + result.unit.ray_writes) << "one beside the other";

    const CosimResult without = cosimulate(bare, scene, bvh, options);
    EXPECT_EQ(result.triangles, without.triangles);
    EXPECT_EQ(without.unit.ray_writes + without.unit.end_writes, 0U);
    UnitCounts counts = result.unit;
    counts.cycles = without.unit.cycles;
    counts.ray_writes = counts.end_writes = 0;
    EXPECT_EQ(counts, without.unit);
  }
}

INSTANTIATE_TEST_SUITE_P(Units, RaySlotsOf, testing::Values(slabs, pair),
                         [](const auto& parameter) { return test_name(parameter.param); });

TEST(RaySlots, BeforeAUnitThatTakesATestEveryFewCycles) {
  const VerilatedDesign design(rtl::behind_ray_slots(
      rtl::make_unit(slabs.design(), slabs.format, rtl::Library::thesis(), {.interval = 3}), few_slots));
  const SlotReport report = driven(slabs, design, 5000);
  EXPECT_EQ(report.received, 5000U);
  EXPECT_EQ(report.faults(), 0U);
  EXPECT_GT(report.under_way, 500U);
}

/// Each answer is waited for, and each write takes one cycle more.
TEST(RaySlots, OneRayInFlightWaitsForItsWrites) {
  const VerilatedDesign design = behind_slots(slabs, few_slots);
  const ref::Scene scene = hills();
  const CosimResult result =
      cosimulate(design, scene, ref::build_bvh(scene.mesh), {.width = 20, .height = 20, .rays_in_flight = 1});
  EXPECT_EQ(result.unit.rtl_mismatches, 0U);
  EXPECT_EQ(result.unit.cycles, result.unit.tests * (static_cast<std::uint64_t>(design.latency()) + 2) +
                                    result.unit.ray_writes + result.unit.end_writes);
}

TEST(RaySlots, EveryRayInFlightNeedsOne) {
  const VerilatedDesign design = behind_slots(slabs, few_slots);
  const ref::Scene scene = hills();
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              (void)cosimulate(design, scene, ref::build_bvh(scene.mesh),
                               {.width = 4, .height = 4, .rays_in_flight = 5});
            }),
            "5 rays in flight: each needs a slot, and there are 4 ray slots");
}

struct Damage {
  const char *name, *good, *bad;
};

const Damage damages[] = {
    {"test beside a write", " & ~(written & (ray_slot == in_slot))", ""},
    {"line of another slot", "line_memory[in_slot]", "line_memory[in_slot ^ 2'd1]"},
    {"end of another slot", "end_memory[in_slot]", "end_memory[in_slot ^ 2'd1]"},
    {"end to another slot", "end_memory[ray_slot]", "end_memory[in_slot]"},
    {"line read again in a stall", "if (read) line_read", "line_read"},
    {"end read again in a stall", "if (read) end_read", "end_read"},
    {"end alone writes the line", "written & ~ray_end_only", "written"},
    {"whole ray leaves its end", "if (written) end_memory", "if (written & ray_end_only) end_memory"},
    {"test lost in a stall", "else if (unit_ready | ~read_valid) read_valid", "else read_valid"},
    {"test survives a reset", "if (rst) read_valid", "if (1'b0) read_valid"},
    {"no gap is closed", "(unit_ready | ~read_valid) & ~(", "unit_ready & read_valid & ~("},
    {"box of a later test", "if (read) begin", "begin"}};

TEST(DamagedRaySlots, AreFound) {
  const TestedUnit narrow{"int_slabs", hls::IntBits{6, 6}};
  EXPECT_EQ(driven(narrow, behind_slots(narrow, few_slots), 5000).faults(), 0U);
  for (const auto& [name, good, bad] : damages)
    EXPECT_GT(driven(narrow, behind_slots(narrow, few_slots, good, bad), 5000).faults(), 0U) << name;
}

/// Co-simulation alone finds that a ray is in the wrong slot.
TEST(DamagedRaySlots, GiveWrongAnswersInAScene) {
  const ref::Scene scene = hills();
  const CosimResult result =
      cosimulate(behind_slots(slabs, few_slots, "line_memory[in_slot]", "line_memory[in_slot ^ 2'd1]"), scene,
                 ref::build_bvh(scene.mesh), {.width = 20, .height = 20, .rays_in_flight = few_slots});
  EXPECT_GT(result.unit.rtl_mismatches, 100U);
}

}  // namespace
}  // namespace hitpipe::sim::ray_slots_test
