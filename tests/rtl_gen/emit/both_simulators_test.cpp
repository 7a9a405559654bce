// The testbench of every wrapper in Icarus and in Verilator, as the emitted Makefile runs them. Each passes,
// and sees a result FIFO that takes more tests than it has places for.
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::both_simulators_test {
namespace {

/// Verilator compiles each wrapping, which takes most of the time. What it says of a testbench does not depend
/// on the unit's interval, so it reads one interval.
std::vector<std::string> simulators(int interval) {
  if (interval == 1) return {"icarus"};
  return {"icarus", "verilator"};
}

/// The unit in one combination of wrappers after another, as emit() knows them. No two have the same Verilog.
std::vector<EmittedDesign> every_wrapping(int interval) {
  const Design& design = find_design("int_slabs");
  const hls::IntBits format{6, 6};
  const Pipeline pipeline = make_pipeline(design.trace(format), Library::thesis(), std::nullopt, interval);
  std::vector<EmittedDesign> all;
  std::set<std::string> known;
  for (const FlowControl flow : {FlowControl::stall, FlowControl::none})
    for (const bool fifo : {false, true})
      for (const bool axi_stream : {false, true}) {
        if (fifo && flow == FlowControl::stall) continue;  // emit() refuses it
        EmittedDesign unit = emit(
            make_unit(design, format, Library::thesis(), pipeline, {.module = "unit", .flow_control = flow}),
            {.axi_stream = axi_stream, .fifo = fifo});
        std::string verilog;
        for (const File& file : unit.files())
          if (file.name.ends_with(".v")) verilog += file.contents;
        if (known.insert(verilog).second) all.push_back(std::move(unit));
      }
  return all;
}

/// The module that contains all others.
std::string outermost(const EmittedDesign& unit) {
  const std::string& testbench =
      unit.more_testbenches.empty() ? unit.testbench.name : unit.more_testbenches.back().name;
  const std::string name = std::filesystem::path(testbench).stem().string();
  return name.substr(0, name.rfind("_tb"));
}

/// The C++ compiler optimises nothing, and compiles Verilator's own code once for all tests.
ToolResult simulated(const std::filesystem::path& folder, const std::string& simulator,
                     const std::string& module) {
  return run_tool(folder, "make", "make",
                  fmt::format("-s -C tb {} UNITS={} OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0 "
                              "OBJCACHE='sh " HITPIPE_SOURCE "/tests/rtl_gen/emit/kept_object.sh'",
                              simulator, module));
}

class EveryWrapper : public testing::TestWithParam<int> {};

TEST_P(EveryWrapper, PassesItsTestbench) {
  int wrapped = 0;
  for (const EmittedDesign& unit : every_wrapping(GetParam())) {
    const ScratchFolder folder;
    host::write_files(folder.path(), unit.files());
    const std::string module = outermost(unit);
    for (const std::string& simulator : simulators(GetParam())) {
      const ToolResult result = simulated(folder.path(), simulator, module);
      EXPECT_EQ(result.status, 0) << module << ' ' << simulator << '\n' << result.output;
      EXPECT_THAT("\n" + result.output, testing::HasSubstr("\nPASS 1000 vectors\n"));
      EXPECT_THAT(result.output, Not(testing::HasSubstr("arning"))) << module << ' ' << simulator;
    }
    ++wrapped;
  }
  EXPECT_EQ(wrapped, 5) << "2 that stall, 3 without flow control";
}

/// Its results must stand still until all places are full, at any interval.
TEST_P(EveryWrapper, FailsWithMoreCreditsThanPlaces) {
  int found = 0;
  for (EmittedDesign unit : every_wrapping(GetParam())) {
    if (!unit.fifo) continue;
    const int places = unit.manifest->at("result_fifo").at("places").get<int>();
    unit.fifo->contents = replaced(unit.fifo->contents, fmt::format("used != 3'd{}", places),
                                   fmt::format("used != 3'd{}", places + 1));
    const ScratchFolder folder;
    host::write_files(folder.path(), unit.files());
    const std::string module = outermost(unit);
    for (const std::string& simulator : simulators(GetParam())) {
      const ToolResult result = simulated(folder.path(), simulator, module);
      EXPECT_NE(result.status, 0) << module << ' ' << simulator;
      // A result is wrong, or results are lost and the rest never come back.
      EXPECT_THAT("\n" + result.output, testing::HasSubstr("\nFAIL ")) << module << ' ' << simulator;
      if (module != unit.module + "_fifo") break;  // the wrappers around it in Icarus alone
    }
    ++found;
  }
  EXPECT_EQ(found, 2) << "a FIFO alone, and in a stream";
}

INSTANTIATE_TEST_SUITE_P(Intervals, EveryWrapper, testing::Values(1, 3), testing::PrintToStringParamName());

}  // namespace
}  // namespace hitpipe::rtl::both_simulators_test
