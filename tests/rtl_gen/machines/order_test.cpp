// The order of statements in a machine's step means nothing: with all that write the next state, or an output,
// in reverse order at the ends of their blocks, every machine has the same graph.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/rtl_gen/machines/graphs.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::machine_order_test {
namespace {

TEST(MachineOrder, ReversedStatementsGiveTheSameGraphs) {
  const ToolResult reversed = run_tool(".", "hitpipe", HITPIPE_REVERSED_MACHINES, "");
  ASSERT_EQ(reversed.status, 0) << reversed.output;
  EXPECT_TRUE(reversed.output == machine_graphs(true)) << reversed.output;
  // The reversed program has machines of its own.
  const ToolResult traced = run_tool(".", "hitpipe", HITPIPE_REVERSED_MACHINES, "traced");
  ASSERT_EQ(traced.status, 0) << traced.output;
  EXPECT_FALSE(traced.output == machine_graphs(false));
}

TEST(MachineOrder, StatementsOfEveryMachineAreReversed) {
  const std::string moved = read_text(std::filesystem::path(HITPIPE_REVERSED) / "moved.txt");
  for (const Machine& machine : machines()) {
    EXPECT_THAT(moved, testing::HasSubstr(fmt::format("{}.hpp ", machine.name)));
    const std::string file = fmt::format("hls/machines/{}.hpp", machine.name);
    EXPECT_NE(read_text(std::filesystem::path(HITPIPE_REVERSED) / file),
              read_text(std::filesystem::path(HITPIPE_SOURCE) / file));
  }
  EXPECT_THAT(moved, testing::HasSubstr("id_queue.hpp 3"));
}

}  // namespace
}  // namespace hitpipe::rtl::machine_order_test
