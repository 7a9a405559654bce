// Units that take a test every few cycles: lint-clean, they pass their testbench, and it finds damage of the
// phase counter and of the selection of operands. The stream and the FIFO around them lose nothing.
#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/emit/axi_stream_bench.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::interval_test {
namespace {

EmittedDesign emitted(const DesignFormat& d, int interval, FlowControl flow, EmitOptions options = {},
                      const std::string& module = "unit") {
  const VectorSet vectors = few_vectors(d);
  options.vectors = &vectors;
  static std::map<std::tuple<std::string, std::string, int>, std::optional<Pipeline>>
      made;  // each takes a while
  std::optional<Pipeline>& pipeline = made[{d.design, d.format, interval}];
  if (!pipeline)
    pipeline = make_pipeline(d.found().trace(d.parsed()), Library::thesis(), std::nullopt, interval);
  return emit(make_unit(d.found(), d.parsed(), Library::thesis(), *pipeline,
                        {.module = module, .flow_control = flow}),
              options);
}

ToolResult replayed(const EmittedDesign& unit) {
  const ScratchFolder folder;
  host::write_files(folder.path(), unit.files());
  return run_tool(folder.path(), "make", "make", "-s -C tb icarus");
}

class EveryFewCycles : public testing::TestWithParam<DesignFormat> {};

TEST_P(EveryFewCycles, IsLintCleanAndPasses) {
  const ScratchFolder folder;
  std::vector<std::vector<std::string>> modules;
  for (const auto& [interval, flow] : {std::pair{2, FlowControl::none}, {3, FlowControl::stall}}) {
    const EmittedDesign unit = emitted(GetParam(), interval, flow, {}, fmt::format("unit_{}", interval));
    host::write_files(folder.path(), unit.files());
    modules.push_back({unit.module});
  }
  expect_silent_tools(folder.path(), modules);
  EXPECT_EQ(run_tool(folder.path(), "make", "make", "-s -C tb icarus").output,
            few_passed + "\n" + few_passed + "\n");
}

TEST_P(EveryFewCycles, TheStreamAnswersUnderEveryPatternOfStalls) {
  constexpr int interval = 3;
  struct Run {
    FlowControl flow;
    std::array<int, 2> modes;
  };
  // The wrappers' own tests run all modes with both.
  for (const auto& [flow, modes] : {Run{FlowControl::stall, {1, 3}}, Run{FlowControl::none, {2, 5}}}) {
    const EmittedDesign unit = emitted(GetParam(), interval, flow, {.axi_stream = true}, "");
    const ScratchFolder folder;
    host::write_files(folder.path(), unit.files());
    std::vector<std::string> modules{unit.module + "_axis", unit.module};
    if (unit.fifo) modules.push_back(unit.module + "_fifo");
    expect_silent_tools(folder.path(), {modules});
    const StreamBench bench(folder.path(), GetParam().found(), GetParam().parsed(), interval);
    for (const int mode : modes) EXPECT_THAT(bench.run(mode), testing::StartsWith(all_passed)) << mode;
    EXPECT_LE(bench.cycles(0), interval * beat_count + unit.manifest->at("latency").get<int>() + 1)
        << "a beat every " << interval << " cycles";
  }
}

/// As many as can be in flight, and one more.
TEST_P(EveryFewCycles, TheFifoHasNoMorePlacesThanItNeeds) {
  for (const int interval : {1, 3, 7, 64}) {
    const EmittedDesign unit = emitted(GetParam(), interval, FlowControl::none, {.fifo = true});
    const int latency = unit.manifest->at("latency").get<int>();
    EXPECT_EQ(unit.manifest->at("result_fifo").at("places"), latency / interval + 2) << interval;
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, EveryFewCycles, testing::ValuesIn(every_small_design()), design_suffix);

/// Its products and sums of several widths run on the same components.
TEST(EveryFewCyclesWidened, TheTriangleTestIsLintCleanAndPasses) {
  for (const int interval : {4, 8}) {
    const EmittedDesign unit = emitted({"int_triangle", "20+1s20"}, interval, FlowControl::stall);
    const ScratchFolder folder;
    host::write_files(folder.path(), unit.files());
    expect_silent_tools(folder.path(), {{"unit"}});
    EXPECT_EQ(replayed(unit).output, few_passed + "\n") << interval;
  }
}

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
