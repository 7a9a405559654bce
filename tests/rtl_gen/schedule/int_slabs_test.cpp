// The integer slabs pipeline against figures 7.4-7.6 and Table 7.2 of the thesis: stages, clock, components,
// latches.
#include <stdexcept>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/schedule/figures.hpp"

namespace hitpipe::rtl::int_slabs_test {
namespace {

Pipeline int_slabs(int n, int t) {
  return int_slabs_pipeline({n, t});
}

TEST(IntSlabs2424, HasTheThesissStagesAndClock) {
  const Pipeline p = int_slabs(24, 24);
  EXPECT_EQ(p.schedule.stages, 5);
  EXPECT_EQ(p.latency(), 5);
  EXPECT_EQ(p.schedule.clock_ps, 3176);
}

TEST(IntSlabs2424, HasTheComponentsOfTable72) {
  EXPECT_EQ(table_7_2(int_slabs(24, 24)), (std::map<std::string, int>{{"latch_1", 6},
                                                                      {"latch_24", 38},
                                                                      {"mux2_24", 16},
                                                                      {"int_subtract_24", 6},
                                                                      {"int_multiply_24", 6},
                                                                      {"int_compare_24", 6}}));
}

// Inputs: 16 words and rinf. Stage 1: two differences and two IRDVCs for each axis. Stage 4: two distances
// for each.
TEST(IntSlabs2424, HasTheLatchesOfFigures74To76) {
  EXPECT_EQ(latches_by_boundary(int_slabs(24, 24)),
            (std::vector<std::string>{"16 x 24, 1 x 1", "13 x 24, 1 x 1", "1 x 24, 1 x 1", "1 x 24, 1 x 1",
                                      "7 x 24, 1 x 1", "1 x 1"}));
}

TEST(IntSlabs2424, CarriesTheRaysLengthToTheLastStage) {
  const Pipeline p = int_slabs(24, 24);
  EXPECT_EQ(times_latched(p, "irlen"), 5) << "input latch and stages 1-4, figure 7.4";
  EXPECT_EQ(times_latched(p, "rinf"), 5);
  EXPECT_EQ(times_latched(p, "irx"), 1);
  EXPECT_EQ(times_latched(p, "d_near_x"), 1);
  EXPECT_EQ(times_latched(p, "d0_x"), 0) << "chosen within stage 1";
  EXPECT_EQ(times_latched(p, "overlap"), 1);
}

// "Int Slabs Pipeline Stage 1: total 1.728 ns", "Stage 5: total 2.109 ns", each with a latch of 176 ps.
TEST(IntSlabs2424, HasTheCriticalPathsOfTheFigures) {
  const Pipeline p = int_slabs(24, 24);
  const auto slot = [&](std::string_view name) { return p.schedule.slots[node_named(p.graph, name)]; };
  EXPECT_EQ(slot("d0_x").ready_ps, 1200);
  EXPECT_EQ(slot("d_near_x").ready_ps, 1376);
  EXPECT_EQ(slot("ir_near_x").stage, 1);
  EXPECT_EQ(slot("ir_near_x").ready_ps + 176, 1728);
  const NodeId product = p.graph[node_named(p.graph, "it_near_x")].args[0];
  EXPECT_EQ(p.schedule.slots[product].stage, 2);
  EXPECT_EQ(p.schedule.slots[product].finish, 4);
  EXPECT_TRUE(p.schedule.slots[product].latched);
  EXPECT_EQ(slot("it_near_xy").ready_ps, 477 + 176);
  EXPECT_EQ(slot("it_near").ready_ps, 2 * (477 + 176));
  EXPECT_EQ(slot("beyond").ready_ps, 2 * (477 + 176) + 477);
  EXPECT_EQ(slot("overlap").stage, 5);
  EXPECT_EQ(slot("overlap").ready_ps + 176, 2109);
}

TEST(IntSlabs2024, HasTheThesissStagesAndClock) {
  const Pipeline p = int_slabs(20, 24);
  EXPECT_EQ(p.schedule.stages, 4);
  EXPECT_EQ(p.schedule.clock_ps, 3176);
}

// The thesis counts the six product latches at 20 bits: 33 of 20 and 4 of 24. The compared values have 24
// bits.
TEST(IntSlabs2024, HasTheComponentsOfTable72WithProductsAtTheirOwnWidth) {
  EXPECT_EQ(table_7_2(int_slabs(20, 24)), (std::map<std::string, int>{{"latch_1", 5},
                                                                      {"latch_20", 33 - 6},
                                                                      {"latch_24", 4 + 6},
                                                                      {"mux2_20", 12},
                                                                      {"mux2_24", 4},
                                                                      {"int_subtract_20", 6},
                                                                      {"int_multiply_20", 6},
                                                                      {"int_compare_24", 6}}));
}

TEST(IntSlabs2024, LatchesByBoundary) {
  const Pipeline p = int_slabs(20, 24);
  EXPECT_EQ(latches_by_boundary(p),
            (std::vector<std::string>{"1 x 24, 15 x 20, 1 x 1", "1 x 24, 12 x 20, 1 x 1", "1 x 24, 1 x 1",
                                      "7 x 24, 1 x 1", "1 x 1"}));
  EXPECT_EQ(times_latched(p, "irlen"), 4);
}

TEST(IntSlabs, OtherFormatsFollowTheLibrary) {
  const struct {
    int n, t, stages, clock_ps;
  } formats[] = {{16, 16, 4, 2776}, {12, 12, 4, 2776}, {6, 6, 4, 2776},  {6, 11, 4, 2776},
                 {32, 6, 6, 3176},  {32, 32, 6, 3176}, {32, 63, 6, 3176}};
  for (const auto& f : formats) {
    SCOPED_TRACE(fmt::format("{}/{}", f.n, f.t));
    const Pipeline p = int_slabs(f.n, f.t);
    EXPECT_EQ(p.schedule.stages, f.stages);
    EXPECT_EQ(p.schedule.clock_ps, f.clock_ps);
    EXPECT_EQ(verify(p.graph, Library::thesis(), p.schedule), std::vector<std::string>{});
  }
}

TEST(IntSlabs, ASlowClockTakesFewerStages) {
  const Graph graph = find_design("int_slabs").trace(hls::IntBits{24, 24});
  // The 1552 ps of stage 1, a multiplier stage and a latch.
  EXPECT_EQ(make_pipeline(graph, Library::thesis(), 4727).schedule.stages, 5);
  EXPECT_EQ(make_pipeline(graph, Library::thesis(), 4728).schedule.stages, 4);
}

TEST(IntSlabs, AClockThatIsTooShortIsToldTheShortest) {
  const Graph graph = find_design("int_slabs").trace(hls::IntBits{24, 24});
  EXPECT_EQ(message_of<std::invalid_argument>(
                [&] { static_cast<void>(make_pipeline(graph, Library::thesis(), 3175)); }),
            "int_slabs: a clock of 3175 ps is too short for int_multiply:24; the smallest that can be met is "
            "3176 ps");
}

}  // namespace
}  // namespace hitpipe::rtl::int_slabs_test
