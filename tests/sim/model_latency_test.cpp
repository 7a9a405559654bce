// Every format builds, and its Verilog answers exactly as many clock edges after a test is taken as the
// schedule has stages. These tests fill the cache of Verilated models for all others.
#include <gtest/gtest.h>

#include "rtl_gen/emit/testbench.hpp"
#include "rtl_gen/pipeline.hpp"
#include "tests/sim/formats.hpp"

namespace hitpipe::sim {
namespace {

class ModelLatency : public testing::TestWithParam<hls::IntBits> {};

/// Edges between the one that takes a lone test and the one that latches its answer.
int measured_latency(Model& model, const std::vector<std::int64_t>& operands, std::uint16_t tag) {
  Pins take{.in_valid = true, .in_tag = tag};
  model.cycle(operands.data(), take);
  EXPECT_TRUE(take.in_ready);
  EXPECT_FALSE(take.out_valid);
  for (int edges = 0; edges < 100; ++edges) {
    Pins wait;
    model.cycle(nullptr, wait);
    if (!wait.out_valid) continue;
    EXPECT_EQ(wait.out_tag, tag);
    return edges;
  }
  return -1;
}

TEST_P(ModelLatency, IsTheScheduledNumberOfStages) {
  const VerilatedDesign& design = verilated(GetParam());
  const rtl::Pipeline pipeline = rtl::make_pipeline(int_slabs().trace(GetParam()), rtl::Library::thesis());
  EXPECT_EQ(design.latency(), pipeline.schedule.stages);
  EXPECT_EQ(design.stages(), pipeline.schedule.stages);
  EXPECT_EQ(design.clock_ps(), pipeline.schedule.clock_ps);
  EXPECT_EQ(design.operand_count(), 17U);
  if (GetParam() == hls::IntBits{24, 24}) {
    EXPECT_EQ(design.latency(), 5);  // section 7.4
  }
  if (GetParam() == hls::IntBits{20, 24}) {
    EXPECT_EQ(design.latency(), 4);
  }
  Model model(design);
  const auto vectors = rtl::operand_vectors(rtl::input_ports(pipeline.graph), 20, 1);
  std::uint16_t tag = 0xFFF0;  // runs through 0
  for (const auto& operands : vectors) EXPECT_EQ(measured_latency(model, operands, tag++), design.latency());
}

INSTANTIATE_TEST_SUITE_P(Formats, ModelLatency, testing::ValuesIn(formats),
                         [](const auto& parameter) { return test_name(parameter.param); });

}  // namespace
}  // namespace hitpipe::sim
