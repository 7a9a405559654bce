// Units without flow control in Verilator: each result comes exactly `latency` cycles after its test, damage
// is found, a scene is traced as by the unit that stalls. The result FIFO around them loses nothing.
#include <gtest/gtest.h>

#include "rtl_gen/emit/result_fifo.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "sim/cosim/cosim.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/formats.hpp"
#include "tests/sim/small_scene.hpp"
#include "tests/sim/testbench.hpp"

namespace hitpipe::sim::flow_control_test {
namespace {

constexpr hls::IntBits narrow{12, 12};
constexpr std::uint64_t seed = 91;

const std::vector<rtl::Port>& ports() {
  static const std::vector<rtl::Port> all = int_slabs().ports(narrow);
  return all;
}

rtl::Unit whole() {
  return rtl::make_unit(int_slabs(), narrow, rtl::Library::thesis(),
                        {.flow_control = rtl::FlowControl::none});
}

/// int_slabs 12/12 without flow control, with `good` in its Verilog replaced.
VerilatedDesign unit(const std::string& good = "", const std::string& bad = "") {
  return VerilatedDesign(damaged(whole(), good, bad));
}

DriveReport driven(const VerilatedDesign& design, const Traffic& traffic) {
  Model model(design);
  return drive_all(model, rtl::operand_vectors(ports(), 20'000, seed), traffic, seed, seed);
}

TEST(WithoutFlowControl, ResultsComeAfterTheLatencyAndInNoOtherCycle) {
  const VerilatedDesign design = unit();
  Model model(design);
  const auto operands = rtl::operand_vectors(ports(), 1, seed);
  // Every pattern of eight cycles with and without a test.
  for (unsigned pattern = 0; pattern < 256; ++pattern) {
    unsigned seen = 0;
    for (int cycle = 0; cycle < 8 + design.latency() + 1; ++cycle) {
      // What the consumer says does not matter.
      Pins pins{.in_valid = cycle < 8 && (pattern >> cycle & 1U) != 0, .out_ready = cycle % 3 == 0};
      model.cycle(operands.front().data(), pins);
      EXPECT_TRUE(pins.in_ready);
      if (pins.out_valid) seen |= 1U << cycle;
    }
    ASSERT_EQ(seen, pattern << (design.latency() + 1));
  }
}

TEST(WithoutFlowControl, AgreesWithGapsAndResets) {
  for (const Traffic& traffic :
       {Traffic{"full", 1.0, 1.0}, Traffic{"gaps", 0.6, 1.0}, Traffic{"resets", 0.8, 1.0, 0.01}}) {
    const DriveReport report = driven(unit(), traffic);
    EXPECT_TRUE(report.clean()) << report.first_failure;
    EXPECT_EQ(report.received, 20'000U);
  }
}

TEST(WithoutFlowControl, DamageIsFound) {
  const Traffic gaps{"gaps", 0.6, 1.0};
  EXPECT_GT(driven(unit("irlen_s2 <= irlen_s1", "irlen_s2 <= irlen_s0"), gaps).wrong_results, 100U);
  EXPECT_GT(driven(unit("tag_s2 <= tag_s1", "tag_s2 <= tag_s0"), gaps).wrong_tags, 100U);
  EXPECT_GT(driven(unit("{valid[3:0], in_valid}", "{valid[3:0], in_valid & ~valid[0]}"), gaps).lost, 100U);
  EXPECT_GT(
      driven(unit("{valid[3:0], in_valid}", "{valid[3:0], in_valid | (valid[0] & ~valid[1])}"), gaps).surplus,
      0U);
}

TEST(WithoutFlowControl, TracesASceneAsTheUnitThatStalls) {
  const ref::Scene scene = hills();
  const ref::Bvh bvh = ref::build_bvh(scene.mesh);
  const CosimOptions options{.width = 40, .height = 30, .referee = true};
  const CosimResult none = cosimulate(unit(), scene, bvh, options);
  const CosimResult stall = cosimulate(verilated(narrow), scene, bvh, options);
  EXPECT_EQ(none.unit.rtl_mismatches, 0U);
  EXPECT_GT(none.unit.tests, 10'000U);
  EXPECT_EQ(none.unit, stall.unit);
  EXPECT_EQ(none.triangles, stall.triangles);
  const CosimResult wrong =
      cosimulate(unit("irlen_s2 <= irlen_s1", "irlen_s2 <= irlen_s0"), scene, bvh, options);
  EXPECT_GT(wrong.unit.rtl_mismatches, 0U);
}

/// The unit behind its result FIFO has the pins of a unit that stalls.
TEST(ResultFifo, LosesNothingWhateverTheConsumerDoes) {
  rtl::Unit behind_fifo = whole();
  behind_fifo.verilog += rtl::result_fifo(behind_fifo.interface, behind_fifo.pipeline->latency());
  behind_fifo.interface = rtl::fifo_interface(behind_fifo.interface);
  const VerilatedDesign design(behind_fifo);
  for (const Traffic& traffic :
       {Traffic{"full", 1.0, 1.0}, Traffic{"gaps and stalls", 0.7, 0.7}, Traffic{"stalls", 1.0, 0.6},
        Traffic{"long stalls", 0.9, 0.1}, Traffic{"resets", 0.9, 0.6, 0.01}}) {
    DriveReport report = driven(design, traffic);
    // Its in_ready does not follow out_ready in the same cycle.
    report.wrong_ready = 0;
    EXPECT_TRUE(report.clean()) << report.first_failure;
    EXPECT_EQ(report.received, 20'000U) << traffic.name;
  }
}

}  // namespace
}  // namespace hitpipe::sim::flow_control_test
