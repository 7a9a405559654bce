// The float pipelines and integer Pluecker against figures 7.2-7.3 and 7.7-7.14 and Table 7.2: stages, clock,
// components, latches.
#include "tests/rtl_gen/schedule/figures.hpp"

#include <gtest/gtest.h>

#include "tests/rtl_gen/catalogue/formats.hpp"

namespace hitpipe::rtl::figures_test {
namespace {

using Counts = std::map<std::string, int>;
using Latches = std::vector<std::string>;

Pipeline pipeline_of(const std::string& design, const std::string& format) {
  return DesignFormat{design, format}.pipeline();
}

TEST(FpSlabs, HasTheThesissStagesAndClock) {
  const Pipeline p = pipeline_of("fp_slabs", "fp32");
  EXPECT_EQ(p.schedule.stages, 13);
  EXPECT_EQ(p.schedule.clock_ps, 2876);
}

TEST(FpSlabs, HasTheComponentsOfTable72) {
  EXPECT_EQ(table_7_2(pipeline_of("fp_slabs", "fp32")), (Counts{{"latch_1", 29},
                                                                {"latch_32", 58},
                                                                {"mux2_32", 10},
                                                                {"fp_subtract_32", 6},
                                                                {"fp_multiply_32", 6},
                                                                {"fp_compare_32", 6}}));
}

// Figure 7.2: the IRDVCs wait for the differences as words. After that only their signs go on.
TEST(FpSlabs, HasTheLatchesOfFigures72And73) {
  Latches expected{"13 x 32, 1 x 1"};
  for (int boundary = 1; boundary <= 6; ++boundary) expected.emplace_back("4 x 32, 1 x 1");
  expected.emplace_back("10 x 32, 1 x 1");
  for (int boundary = 8; boundary <= 11; ++boundary) expected.emplace_back("1 x 32, 4 x 1");
  expected.emplace_back("7 x 32, 4 x 1");
  expected.emplace_back("1 x 1");
  EXPECT_EQ(latches_by_boundary(pipeline_of("fp_slabs", "fp32")), expected);
}

// "FP Slabs Pipeline Stage 13: total 2.285 ns", including a latch of 176 ps.
TEST(FpSlabs, HasTheCriticalPathOfFigure73) {
  const Pipeline p = pipeline_of("fp_slabs", "fp32");
  const Slot slot = p.schedule.slots[node_named(p.graph, "overlap")];
  EXPECT_EQ(slot.stage, 13);
  EXPECT_EQ(slot.ready_ps + 176, 2285);
}

TEST(FpPlucker, HasTheThesissStagesAndClock) {
  const Pipeline p = pipeline_of("fp_plucker", "fp32");
  EXPECT_EQ(p.schedule.stages, 20);
  EXPECT_EQ(p.schedule.clock_ps, 2876);
}

// Table 7.2 does not count the input latches: 15 words and rinf.
TEST(FpPlucker, HasTheComponentsOfTable72AndTheInputLatches) {
  EXPECT_EQ(table_7_2(pipeline_of("fp_plucker", "fp32")), (Counts{{"latch_1", 20 + 1},
                                                                  {"latch_32", 45 + 15},
                                                                  {"mux2_1", 6},
                                                                  {"mux2_32", 18},
                                                                  {"fp_subtract_32", 12},
                                                                  {"fp_multiply_32", 12},
                                                                  {"fp_compare_32", 12}}));
}

TEST(FpPlucker, HasTheLatchesOfFigures77To710) {
  Latches expected{"15 x 32, 1 x 1"};
  for (int boundary = 1; boundary <= 6; ++boundary) expected.emplace_back("3 x 32, 1 x 1");
  expected.emplace_back("9 x 32, 1 x 1");
  for (int boundary = 8; boundary <= 11; ++boundary) expected.emplace_back("1 x 1");
  expected.emplace_back("12 x 32, 1 x 1");
  for (int boundary = 13; boundary <= 18; ++boundary) expected.emplace_back("1 x 1");
  expected.emplace_back("6 x 32, 1 x 1");
  expected.emplace_back("1 x 1");
  EXPECT_EQ(latches_by_boundary(pipeline_of("fp_plucker", "fp32")), expected);
}

// "FP Pluecker Pipeline Stage 20: total delay 0.878 ns".
TEST(FpPlucker, HasTheCriticalPathOfFigure710) {
  const Pipeline p = pipeline_of("fp_plucker", "fp32");
  const Slot slot = p.schedule.slots[node_named(p.graph, "inside")];
  EXPECT_EQ(slot.stage, 20);
  EXPECT_EQ(slot.ready_ps + 176, 878);
}

TEST(IntPlucker, HasTheThesissStagesAndClock) {
  EXPECT_EQ(pipeline_of("int_plucker", "24/24").schedule.stages, 5);
  EXPECT_EQ(pipeline_of("int_plucker", "20/24").schedule.stages, 4);
  EXPECT_EQ(pipeline_of("int_plucker", "24/24").schedule.clock_ps, 3176);
  EXPECT_EQ(pipeline_of("int_plucker", "20/24").schedule.clock_ps, 3176);
}

// As printed, except for the 15 words and rinf of the input latches and for the side relations. The
// difference of two 24-bit terms has 25 bits (section 6.3.2); the table prints 24.
TEST(IntPlucker, HasTheComponentsOfTable72WithSidesAtTheirOwnWidth) {
  EXPECT_EQ(table_7_2(pipeline_of("int_plucker", "24/24")), (Counts{{"latch_1", 5 + 1},
                                                                    {"latch_24", 27 + 15},
                                                                    {"mux2_1", 6},
                                                                    {"mux2_24", 18},
                                                                    {"int_subtract_24", 6},
                                                                    {"int_subtract_25", 6},
                                                                    {"int_multiply_24", 12},
                                                                    {"int_compare_24", 6},
                                                                    {"int_compare_25", 6}}));
  EXPECT_EQ(table_7_2(pipeline_of("int_plucker", "20/24")), (Counts{{"latch_1", 4 + 1},
                                                                    {"latch_20", 15 + 15},
                                                                    {"latch_24", 12},
                                                                    {"mux2_1", 6},
                                                                    {"mux2_20", 18},
                                                                    {"int_subtract_20", 6},
                                                                    {"int_subtract_25", 6},
                                                                    {"int_multiply_20", 12},
                                                                    {"int_compare_20", 6},
                                                                    {"int_compare_25", 6}}));
}

TEST(IntPlucker, HasTheLatchesOfFigures711To714) {
  EXPECT_EQ(latches_by_boundary(pipeline_of("int_plucker", "24/24")),
            (Latches{"15 x 24, 1 x 1", "15 x 24, 1 x 1", "1 x 1", "1 x 1", "12 x 24, 1 x 1", "1 x 1"}));
  EXPECT_EQ(latches_by_boundary(pipeline_of("int_plucker", "20/24")),
            (Latches{"15 x 20, 1 x 1", "15 x 20, 1 x 1", "1 x 1", "12 x 24, 1 x 1", "1 x 1"}));
}

// Stage 5 takes 2.078 ns with a 24-bit subtractor. By the library's law 25 bits have the same delay.
TEST(IntPlucker, HasTheCriticalPathsOfFigures712And714) {
  const Pipeline p = pipeline_of("int_plucker", "24/24");
  EXPECT_EQ(p.schedule.slots[node_named(p.graph, "q_plane_0")].ready_ps + 176, 1552);
  EXPECT_EQ(p.schedule.slots[node_named(p.graph, "extent")].stage, 1);
  const Slot slot = p.schedule.slots[node_named(p.graph, "inside")];
  EXPECT_EQ(slot.stage, 5);
  EXPECT_EQ(slot.ready_ps + 176, 2078);
}

}  // namespace
}  // namespace hitpipe::rtl::figures_test
