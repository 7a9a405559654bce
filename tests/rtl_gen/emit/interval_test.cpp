// Units that take a test every few cycles: lint-clean, they pass their testbench, and it finds damage of the
// phase counter and of the selection of operands.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "host/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::interval_test {
namespace {

EmittedDesign emitted(const DesignFormat& d, int interval, FlowControl flow) {
  return emit(d.found(), d.parsed(), Library::thesis(),
              make_pipeline(d.found().trace(d.parsed()), Library::thesis(), std::nullopt, interval),
              {.module = "unit", .flow_control = flow});
}

ToolResult replayed(const EmittedDesign& unit) {
  const ScratchFolder folder;
  host::write_files(folder.path(), unit.files());
  return run_tool(folder.path(), "make", "make", "-s -C tb icarus");
}

class EveryFewCycles : public testing::TestWithParam<DesignFormat> {};

TEST_P(EveryFewCycles, IsLintCleanAndPasses) {
  for (const int interval : {2, 3}) {
    for (const FlowControl flow : {FlowControl::stall, FlowControl::none}) {
      const EmittedDesign unit = emitted(GetParam(), interval, flow);
      const ScratchFolder folder;
      host::write_files(folder.path(), unit.files());
      expect_silent_tools(folder.path(), {{"unit"}});
      EXPECT_EQ(replayed(unit).output, "PASS 1000 vectors\n") << interval << flow_control_name(flow);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, EveryFewCycles, testing::ValuesIn(every_design({"16/16"})), design_suffix);

TEST(EveryFewCyclesDamaged, IsFound) {
  for (const FlowControl flow : {FlowControl::stall, FlowControl::none}) {
    const EmittedDesign unit = emitted({"int_slabs", "16/16"}, 3, flow);
    for (const auto& [good, bad] :
         {std::pair{"phase == 2'd2 ? 2'd0", "phase == 2'd1 ? 2'd0"}, {"2'd1: begin", "2'd0: begin"}}) {
      EmittedDesign damaged = unit;
      damaged.verilog.contents = replaced(damaged.verilog.contents, good, bad);
      const ToolResult result = replayed(damaged);
      EXPECT_NE(result.status, 0) << bad;
      EXPECT_NE(result.output.find("FAIL"), std::string::npos) << result.output;
    }
  }
}

}  // namespace
}  // namespace hitpipe::rtl::interval_test
