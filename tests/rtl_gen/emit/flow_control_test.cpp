// Units without flow control: no ready and no enable anywhere, the testbench sees a wrong latency and lost
// and invented results, and the wrappers around them lose nothing under any pattern of stalls.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/emit/manifest.hpp"
#include "rtl_gen/emit/result_fifo.hpp"
#include "rtl_gen/verilog/module_interface.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/emit/axi_stream_bench.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::flow_control_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// With the list of files.
std::string written_manifest(const EmittedDesign& unit) {
  return unit.files()[1].contents;
}

class WithoutFlowControl : public testing::TestWithParam<DesignFormat> {
 protected:
  void SetUp() override {
    unit = GetParam().emitted({.axi_stream = true, .fifo = true}, {.flow_control = FlowControl::none});
    host::write_files(folder.path(), unit.files());
  }

  EmittedDesign unit;
  ScratchFolder folder;
};

TEST_P(WithoutFlowControl, NoReadyAndNoEnableButTheSameRegisters) {
  const std::string& none = unit.verilog.contents;
  const std::string stall = GetParam().emitted().verilog.contents;
  for (const char* const word : {"ready", "advance", "if (en)", ".en(", "wire en,", "wire en\n"})
    EXPECT_EQ(times(none, word), 0) << word;
  EXPECT_EQ(times(none, "  reg "), times(stall, "  reg "));
  EXPECT_EQ(times(none, " <= "), times(stall, " <= "));
  EXPECT_THAT(none,
              HasSubstr("\n// Flow control: none. Nothing waits, and a result is there for one cycle.\n"));
}

TEST_P(WithoutFlowControl, TheStreamAnswersUnderEveryPatternOfStalls) {
  const StreamBench bench(folder.path(), GetParam().found(), GetParam().parsed());
  EXPECT_EQ(bench.cycles(0), beat_count + unit.manifest->at("latency").get<int>() + 1) << "a result a cycle";
  for (const int mode : {1, 2, 3, 5}) EXPECT_THAT(bench.run(mode), StartsWith(all_passed)) << mode;
  EXPECT_LT(bench.cycles(4), 2 * beat_count + 50) << "half of the cycles are stalls; the FIFO adds none";
}

TEST_P(WithoutFlowControl, TheManifestSaysSo) {
  const Json& json = *unit.manifest;
  const EmittedDesign with_stalls = GetParam().emitted();
  const Json& stalls = *with_stalls.manifest;
  EXPECT_EQ(stalls.at("flow_control"), "stall");
  EXPECT_EQ(json.at("flow_control"), "none");
  EXPECT_EQ(head_of(written_manifest(unit)).flow_control, FlowControl::none);
  EXPECT_EQ(json.at("by_stage"), stalls.at("by_stage"));
  const Json& fifo = json.at("result_fifo");
  EXPECT_EQ(fifo.at("ports"), stalls.at("ports")) << "the wrapper has the ports of a unit that stalls";
  EXPECT_EQ(fifo.at("places"), json.at("latency").get<int>() + 2);
  EXPECT_EQ(fifo.at("latency"), json.at("latency"));
  Json without = stalls.at("ports");
  std::erase_if(without.get_ref<Json::array_t&>(), [](const Json& port) {
    return port.at("name") == "in_ready" || port.at("name") == "out_ready";
  });
  EXPECT_EQ(json.at("ports"), without);
  for (const char* const file : {"_fifo.v", "_axis.v"})
    EXPECT_THAT(head_of(written_manifest(unit)).files, testing::Contains(unit.module + file));
}

TEST(LintWithoutFlowControl, IsSilent) {
  const ScratchFolder folder;
  std::vector<std::vector<std::string>> modules;
  for (const DesignFormat& d : every_small_design()) {
    const EmittedDesign unit =
        d.emitted({.axi_stream = true, .fifo = true}, {.flow_control = FlowControl::none});
    host::write_files(folder.path(), unit.files());
    modules.push_back({unit.module + "_axis", unit.module + "_fifo", unit.module});
  }
  expect_silent_tools(folder.path(), modules, "; select -assert-none t:$dlatch");
}

INSTANTIATE_TEST_SUITE_P(Designs, WithoutFlowControl, testing::ValuesIn(every_small_design()), design_suffix);

/// What the testbench says in Icarus about int_slabs 6/6 with a change in its Verilog.
std::string verdict_on(const std::string& good, const std::string& bad) {
  const ScratchFolder folder;
  const EmittedDesign unit =
      DesignFormat{"int_slabs", "6/6"}.emitted({}, {.module = "unit", .flow_control = FlowControl::none});
  host::write_files(folder.path(), unit.files());
  damage(folder / "unit.v", good, bad);
  const ToolResult result = run_tool(folder.path(), "make", "make", "-s -C tb icarus");
  EXPECT_EQ(result.status == 0, result.output.find("FAIL") == std::string::npos) << result.output;
  const std::size_t verdict = std::min(result.output.find("PASS"), result.output.find("FAIL"));
  return verdict == std::string::npos
             ? result.output
             : result.output.substr(verdict, result.output.find('\n', verdict) - verdict);
}

TEST(TestbenchWithoutFlowControl, SeesLatencyLossAndInvention) {
  EXPECT_EQ(verdict_on("unit", "unit"), "PASS 1000 vectors");
  const std::string early = "FAIL cycle 4: out_valid 1, and no test was sent 4 cycles before";
  const char* const no_result = ": no result 4 cycles after its operands";
  // A stage more or less for the whole unit.
  EXPECT_THAT(verdict_on("assign out_valid = valid[4];", "assign out_valid = valid[3];"),
              StartsWith(early.substr(0, 10)));
  EXPECT_THAT(verdict_on("assign out_valid = valid[4];",
                         "reg late; always @(posedge clk) late <= valid[4]; assign out_valid = late;"),
              testing::AllOf(StartsWith("FAIL vector 0 ("), HasSubstr(no_result)));
  EXPECT_THAT(verdict_on("{valid[3:0], in_valid}", "{valid[3:0], in_valid & (in_tag != 16'd517)}"),
              testing::AllOf(StartsWith("FAIL vector 517 ("), HasSubstr(no_result)));
  EXPECT_THAT(verdict_on("{valid[3:0], in_valid}", "{valid[3:0], in_valid | (tag_s0 == 16'd517)}"),
              testing::AllOf(StartsWith("FAIL"), HasSubstr(": ")));
  // After the last vector, too: the tag stays one past it.
  EXPECT_THAT(verdict_on("{valid[3:0], in_valid}", "{valid[3:0], in_valid | (in_tag == 16'd1000)}"),
              testing::AllOf(StartsWith("FAIL cycle "), HasSubstr("no test was sent 4 cycles before")));
  EXPECT_THAT(verdict_on("tag_s1 <= tag_s0", "tag_s1 <= in_tag"), StartsWith("FAIL vector "));
  EXPECT_THAT(verdict_on("izmin_s0 - irz_s0", "izmin_s0 + irz_s0"), StartsWith("FAIL vector "));
}

TEST(ResultFifo, DamagedOnesFail) {
  const DesignFormat d{"int_slabs", "6/6"};
  const struct {
    const char *good, *bad;
    int mode;
  } damages[] = {{"used != 3'd6", "used != 3'd7", 2},
                 {"used != 3'd6", "1'b1", 2},
                 {"if (arrives) held", "held", 1},
                 {"held[oldest[2:0]]", "held[0]", 2},
                 {"else if (arrives & ~given) oldest", "else if (arrives) oldest", 1},
                 {"if (rst) oldest", "if (1'b0) oldest", 1},
                 {"if (rst) used", "if (1'b0) used", 1},
                 {"out_valid = waits | arrives", "out_valid = out_ready & (waits | arrives)", 1},
                 {"assign in_ready = used", "assign in_ready = out_ready & used", 1},
                 {".in_valid(taken)", ".in_valid(in_valid)", 2}};
  const std::vector<File> files =
      d.emitted({.axi_stream = true}, {.flow_control = FlowControl::none}).files();
  const ScratchFolder folder;
  const auto bench_of = [&](const char* good, const char* bad) {
    host::write_files(folder.path(), files);
    damage(folder / "int_slabs_6_6_fifo.v", good, bad);
    return StreamBench(folder.path(), d.found(), d.parsed());
  };
  for (const auto& [good, bad, mode] : damages)
    EXPECT_THAT(bench_of(good, bad).run(mode), StartsWith("FAIL")) << bad;
  EXPECT_GT(bench_of("3'd6", "3'd5").cycles(0), beat_count * 11 / 10)
      << "a place less is correct, and slower";
}

// docs/flow_control.sh measured these.
TEST(ResultFifo, IsTheDefaultInAWrapperWhereItCostsLess) {
  const auto usual = [](const DesignFormat& d) { return wrapped_flow_control(d.pipeline()); };
  EXPECT_EQ(usual({"int_slabs", "20/24"}), FlowControl::none);
  EXPECT_EQ(usual({"int_slabs", "16/16"}), FlowControl::none);
  EXPECT_EQ(usual({"fp_slabs", "fp32"}), FlowControl::none);
  EXPECT_EQ(usual({"int_major_pair", "20+1/13"}), FlowControl::stall) << "its results have 83 bits";
}

TEST(ResultFifo, APortWithTheNameOfItsOwnRejected) {
  const ModuleInterface unit =
      unit_interface("unit", {{"used", 4, false}}, {{"hit", 1, false}}, FlowControl::none);
  EXPECT_EQ(message_of([&] { return result_fifo(unit, 3); }),
            "unit: its port used has the name of one of unit_fifo");
}

TEST(FlowControlOptions, ThatDoNotGoTogetherRejected) {
  const DesignFormat d{"int_slabs", "6/6"};
  const auto refusal = [&](const EmitOptions& options) {
    return message_of<std::invalid_argument>([&] { return d.emitted(options); });
  };
  EXPECT_EQ(refusal({.fifo = true}),
            "result FIFO: flow control stall; allowed is none, because a unit that stalls holds its results");
}

TEST(FlowControlOfAManifest, UnknownOneRejected) {
  Json older = *DesignFormat{"int_slabs", "6/6"}.emitted().manifest;
  older["flow_control"] = "some";
  EXPECT_EQ(message_of([&] { return head_of(older.dump()); }),
            "\"flow_control\" is \"some\", allowed are stall, none");
  older["flow_control"] = std::string(1000, 'x');
  EXPECT_EQ(message_of([&] { return head_of(older.dump()); }),
            "\"flow_control\" is \"" + std::string(50, 'x') + "... (1000 bytes)\", allowed are stall, none");
  older.erase("flow_control");
  EXPECT_EQ(head_of(older.dump()).flow_control, FlowControl::stall);
}

TEST(FlowControlInTheCore, WrappersAreItsTops) {
  const DesignFormat d{"int_slabs", "20/24"};
  const std::string fifo = d.emitted({.fifo = true}, {.flow_control = FlowControl::none}).core.contents;
  EXPECT_THAT(fifo, HasSubstr("  fifo:\n    files: [int_slabs_fifo.v]\n"));
  EXPECT_THAT(fifo, HasSubstr("filesets: [rtl, fifo]\n    toplevel: int_slabs_fifo\n"));
  const std::string axis = d.emitted({.axi_stream = true}, {.flow_control = FlowControl::none}).core.contents;
  EXPECT_THAT(axis, HasSubstr("filesets: [rtl, fifo, axis]\n    toplevel: int_slabs_axis\n"));
  EXPECT_THAT(d.emitted({.axi_stream = true}).core.contents,
              HasSubstr("filesets: [rtl, axis]\n    toplevel: int_slabs_axis\n"));
}

}  // namespace
}  // namespace hitpipe::rtl::flow_control_test
