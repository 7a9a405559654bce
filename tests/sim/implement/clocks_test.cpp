// Clocks that are tried for a chip: each has fewer stages than the one before.
#include "sim/implement/clocks.hpp"

#include <gtest/gtest.h>

#include "rtl_gen/pipeline.hpp"

namespace hitpipe::sim::clocks_test {
namespace {

TEST(ClocksToTry, BeginWithTheShortestAndHaveFewerStagesEach) {
  const rtl::Library library = rtl::library_called("ice40_up5k");
  const rtl::Design& design = rtl::find_design("int_major_pair");
  const rtl::Graph graph = design.trace(design.default_format);
  const std::vector<int> all = clocks_to_try(graph, library, 100);
  EXPECT_EQ(all.front(), rtl::shortest_clock_ps(graph, library));
  int before = 1000;
  for (const int clock : all) {
    const int stages = rtl::make_pipeline(graph, library, clock).schedule.stages;
    EXPECT_LT(stages, before) << clock;
    before = stages;
  }
  const std::vector<int> few = clocks_to_try(graph, library, 3);
  ASSERT_EQ(few.size(), 3U);
  EXPECT_EQ(few.front(), all.front());
  EXPECT_EQ(few.back(), all.back());
}

}  // namespace
}  // namespace hitpipe::sim::clocks_test
