// Every unit builds, and its Verilog answers exactly as many clock edges after it takes a test as the
// schedule has stages. These tests fill the cache of Verilated models for all others.
#include <map>

#include <gtest/gtest.h>

#include "rtl_gen/emit/vectors.hpp"
#include "rtl_gen/pipeline.hpp"
#include "tests/sim/units.hpp"

namespace hitpipe::sim::model_latency_test {
namespace {

class ModelLatency : public testing::TestWithParam<TestedUnit> {};

/// Clock edges from the one that takes a single test to the one that latches its answer.
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
  const rtl::Pipeline pipeline =
      rtl::make_pipeline(GetParam().design().trace(GetParam().format), rtl::Library::thesis());
  EXPECT_EQ(design.latency(), pipeline.schedule.stages);
  EXPECT_EQ(design.operand_count(), GetParam().ports().size());
  const std::map<std::string_view, std::size_t> operand_counts{
      {"fp_slabs", 14}, {"int_slabs", 17}, {"fp_plucker", 16}, {"int_plucker", 16}, {"int_major", 21}};
  if (operand_counts.contains(GetParam().name)) {
    EXPECT_EQ(design.operand_count(), operand_counts.at(GetParam().name));
  }
  // Section 7.4 and Table 7.2.
  const std::map<std::string, int> stages{{"fp_slabs_fp32", 13},    {"fp_plucker_fp32", 20},
                                          {"int_slabs_24_24", 5},   {"int_slabs_20_24", 4},
                                          {"int_plucker_24_24", 5}, {"int_plucker_20_24", 4}};
  EXPECT_EQ(stages.contains(test_name(GetParam())), GetParam().of_the_thesis());
  if (GetParam().of_the_thesis()) {
    EXPECT_EQ(design.latency(), stages.at(test_name(GetParam())));
  }
  Model model(design);
  const auto vectors = rtl::operand_vectors(rtl::input_ports(pipeline.graph), 20, 1);
  std::uint16_t tag = 0xFFF0;  // runs through 0
  for (const auto& operands : vectors) EXPECT_EQ(measured_latency(model, operands, tag++), design.latency());
}

INSTANTIATE_TEST_SUITE_P(Units, ModelLatency, testing::ValuesIn(units()),
                         [](const auto& parameter) { return test_name(parameter.param); });

}  // namespace
}  // namespace hitpipe::sim::model_latency_test
