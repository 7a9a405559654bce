// The comparisons can fail: Verilog damaged in one place, with the same entry points, is reported.
#include <stdexcept>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "host/process.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "sim/cosim/ray_unit.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/temporary_folder.hpp"
#include "tests/sim/testbench.hpp"

namespace hitpipe::sim::damaged_verilog_test {
namespace {

constexpr hls::IntBits damaged_bits{12, 12};
constexpr Traffic traffic{"gaps and stalls", 0.7, 0.7};
constexpr Traffic resets{"gaps, stalls and resets", 0.7, 0.7, 0.01};
constexpr std::uint64_t seed = 74;

/// The design with its Verilog edited by a sed command. Fails when the command changes nothing.
VerilatedDesign edited(const std::string& sed) {
  rtl::Unit unit = rtl::make_unit(int_slabs(), damaged_bits, rtl::Library::thesis());
  const std::string whole = unit.verilog;
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.write("int_slabs.v", whole);
  EXPECT_TRUE(host::run({"sed", "-i", sed, file.string()}).succeeded()) << sed;
  unit.verilog = host::read_file(file);
  EXPECT_NE(unit.verilog, whole) << sed;
  return VerilatedDesign(unit);
}

DriveReport driven(const VerilatedDesign& design, const Traffic& with = traffic) {
  const std::vector<rtl::Port> ports = int_slabs().ports(damaged_bits);
  Model model(design);
  return drive_all(model, rtl::operand_vectors(ports, 20'000, seed), with, seed, seed);
}

/// The counts of one unit with 8 rays in flight that sees the hills from one point.
UnitCounts traced(const VerilatedDesign& design) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const auto feed = make_feed(int_slabs(), damaged_bits, bvh);
  RayUnit unit({.verilated = &design,
                .evaluate = int_slabs().evaluate(damaged_bits),
                .feed = feed.get(),
                .bvh = &bvh,
                .mesh = &scene.mesh,
                .rays_in_flight = 8,
                .referee = false});
  std::uint32_t given = 0;
  unit.run(
      [&]() -> std::optional<RayJob> {
        if (given == 400) return std::nullopt;
        const auto x = static_cast<float>(given % 20);
        const auto y = static_cast<float>(given / 20);
        const glm::vec3 direction(0.04F * x - 0.38F, 0.04F * y - 0.68F, -1.0F);
        return RayJob{{scene.camera.eye, direction, ref::Ray::infinite}, ref::Query::closest, given++};
      },
      [](const RayJob&, const RayAnswer&) {});
  return unit.counts();
}

TEST(DamagedVerilog, WholeOneIsClean) {
  const DriveReport report = driven(verilated(damaged_bits));
  EXPECT_TRUE(report.clean()) << report.first_failure;
  EXPECT_EQ(report.first_failure, "");
  EXPECT_EQ(report.received, 20'000U);
  const UnitCounts counts = traced(verilated(damaged_bits));
  EXPECT_EQ(counts.rtl_mismatches, 0U);
  EXPECT_GT(counts.box_tests, 4'000U);
}

TEST(DamagedVerilog, SumInPlaceOfOneDifferenceGivesWrongHits) {
  const VerilatedDesign design = edited("0,/ - /s// + /");
  const DriveReport report = driven(design);
  EXPECT_GT(report.wrong_results, 100U);
  EXPECT_EQ(report.wrong_tags + report.lost + report.surplus + report.not_held, 0U);
  EXPECT_EQ(report.received, 20'000U);
  // The printed text is enough to replay it: both answers, every operand in hexadecimal, the seeds.
  EXPECT_THAT(
      report.first_failure,
      testing::MatchesRegex("hit [01] tag [0-9]+, expected hit [01] tag [0-9]+ of vector [0-9]+ of seed 74: "
                            "irx=0x[0-9a-f]+ .*izmax=0x[0-9a-f]+; gaps and stalls traffic of seed 74"));
  EXPECT_GT(traced(design).rtl_mismatches, 0U);
}

TEST(DamagedVerilog, SwappedMuxArmsGiveWrongHits) {
  const VerilatedDesign design = edited(R"(0,/ ? \([^ ]*\) : \([^ ]*\);/s// ? \2 : \1;/)");
  const DriveReport report = driven(design);
  EXPECT_GT(report.wrong_results, 100U);
  EXPECT_EQ(report.wrong_tags + report.lost + report.surplus + report.not_held, 0U);
  EXPECT_GT(traced(design).rtl_mismatches, 0U);
}

/// Exchanges pairs of tags, so a ray in flight gets its neighbour's answer.
TEST(DamagedVerilog, ExchangedTagsAreNotTheOldestTests) {
  const VerilatedDesign design = edited("s/tag_s0 <= in_tag;/tag_s0 <= in_tag ^ 1;/");
  const DriveReport report = driven(design);
  EXPECT_EQ(report.wrong_tags, 20'000U);
  EXPECT_EQ(report.wrong_results, 0U);
  // Also where both rays get the same HIT, so that only the order tells.
  const UnitCounts counts = traced(design);
  EXPECT_GT(counts.box_tests, 500U);
  EXPECT_GE(counts.rtl_mismatches, counts.box_tests);
}

TEST(DamagedVerilog, PipelineThatNeverWaitsLosesAnswers) {
  const DriveReport report = driven(edited("s/wire advance = .*;/wire advance = 1;/"));
  EXPECT_GT(report.not_held, 100U);
  EXPECT_GT(report.lost, 100U);
  EXPECT_GT(report.wrong_ready, 100U);
}

TEST(DamagedVerilog, TestsThatOutliveAResetAreNotTheOldest) {
  const VerilatedDesign design = edited("s/if (rst) valid <= [^;]*;/if (rst) valid <= valid;/");
  EXPECT_TRUE(driven(design).clean());
  const DriveReport report = driven(design, resets);
  EXPECT_GT(report.resets, 100U);
  EXPECT_GT(report.surplus + report.wrong_tags, report.resets);
  const DriveReport whole = driven(verilated(damaged_bits), resets);
  EXPECT_TRUE(whole.clean()) << whole.first_failure;
  EXPECT_EQ(whole.received, 20'000U);
  EXPECT_GT(whole.dropped, whole.resets);
}

TEST(DamagedVerilog, PipelineThatTakesNothingIsRejected) {
  const VerilatedDesign design = edited("s/assign in_ready = .*;/assign in_ready = 0;/");
  EXPECT_EQ(driven(design).lost, 20'000U);
  EXPECT_EQ(message_of<std::runtime_error>([&] { traced(design); }),
            "int_slabs_12_12: no answer to a test within its latency");
}

}  // namespace
}  // namespace hitpipe::sim::damaged_verilog_test
