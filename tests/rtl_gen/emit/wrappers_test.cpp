// Wrappers around wrappers: a FIFO behind the unit, AXI4-Stream around it. Each has a testbench of its own, tools take
// them, and damage is found.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "host/files.hpp"
#include "rtl_gen/emit/files.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/text.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::wrappers_test {
namespace {

using testing::ElementsAre;

struct Choice {
  FlowControl flow = FlowControl::stall;
  bool fifo = false;
  bool axi_stream = false;
  int interval = 1;
  bool few = true;  ///< vectors
};

EmittedDesign emitted(const DesignFormat& d, const Choice& choice) {
  const VectorSet vectors = few_vectors(d);
  return emit(
      d.unit({.module = "unit", .flow_control = choice.flow, .interval = choice.interval}),
      {.axi_stream = choice.axi_stream, .fifo = choice.fifo, .vectors = choice.few ? &vectors : nullptr});
}

/// The modules that the user may instantiate, from the outermost on.
std::vector<std::string> modules_of(const EmittedDesign& unit) {
  std::vector<std::string> modules;
  for (const File& testbench : unit.more_testbenches)
    modules.insert(modules.begin(),
                   testbench.name.substr(3, testbench.name.size() - 3 - std::string("_tb.sv").size()));
  modules.push_back(unit.module);
  return modules;
}

/// What the testbench of a module prints.
std::string replayed(const std::filesystem::path& folder, const std::string& module) {
  const ToolResult compiled = run_tool(folder / "tb", "iverilog", "iverilog",
                                       fmt::format("-g2012 -Wall -y .. -o tb {0}_tb.sv ../{0}.v", module));
  EXPECT_EQ(compiled.output, "") << module;
  return run_tool(folder / "tb", "iverilog", "vvp", "-n tb").output;
}

class Wrapped : public testing::TestWithParam<DesignFormat> {};

TEST_P(Wrapped, EveryModulePassesItsTestbench) {
  for (const Choice& choice : {Choice{.flow = FlowControl::none, .axi_stream = true},
                               Choice{.flow = FlowControl::none, .fifo = true, .interval = 3},
                               Choice{.axi_stream = true, .interval = 2}}) {
    // Wrappers of a design that has one large format are those of all others.
    if (GetParam().parsed().family().single && choice.interval > 1) continue;
    const EmittedDesign unit = emitted(GetParam(), choice);
    const ScratchFolder folder;
    host::write_files(folder.path(), unit.files());
    const std::vector<std::string> modules = modules_of(unit);
    expect_silent_tools(folder.path(), {modules});
    for (const std::string& module : modules)
      EXPECT_THAT(replayed(folder.path(), module), testing::HasSubstr(few_passed)) << module;
  }
}

INSTANTIATE_TEST_SUITE_P(Designs, Wrapped, testing::ValuesIn(every_small_design()), design_suffix);

TEST(Wrappers, StandAroundOneAnother) {
  const DesignFormat slabs{"int_slabs", "6/6"};
  EXPECT_THAT(modules_of(emitted(slabs, {.axi_stream = true})), ElementsAre("unit_axis", "unit"));
  EXPECT_THAT(modules_of(emitted(slabs, {.flow = FlowControl::none, .fifo = true})),
              ElementsAre("unit_fifo", "unit"));
  const EmittedDesign all = emitted(slabs, {.flow = FlowControl::none, .axi_stream = true});
  EXPECT_THAT(modules_of(all), ElementsAre("unit_axis", "unit_fifo", "unit"));
  EXPECT_THAT(all.axi_stream->contents, testing::HasSubstr("  unit_fifo #(.TAG_BITS(TAG_BITS)) design_i ("));
  EXPECT_THAT(all.core.contents,
              testing::HasSubstr("filesets: [rtl, fifo, axis, tb]\n    toplevel: unit_axis_tb"));
}

struct Damage {
  const char *file, *good, *bad;
};
void PrintTo(const Damage& damage, std::ostream* out) {
  *out << damage.good;
}
class DamagedWrapper : public testing::TestWithParam<Damage> {};

TEST_P(DamagedWrapper, FailsItsTestbench) {
  const auto& [file, good, bad] = GetParam();
  const EmittedDesign unit = emitted({"int_slabs", "6/6"}, {.axi_stream = true, .few = false});
  const ScratchFolder folder;
  host::write_files(folder.path(), unit.files());
  EXPECT_THAT(replayed(folder.path(), "unit_axis"), testing::HasSubstr("PASS"));
  write_text(folder / file, replaced(read_text(folder / file), good, bad));
  EXPECT_THAT(run_tool(folder / "tb", "iverilog", "iverilog",
                       "-g2012 -y .. -o tb unit_axis_tb.sv ../unit_axis.v && vvp -n tb")
                  .output,
              testing::HasSubstr("FAIL"));
}

INSTANTIATE_TEST_SUITE_P(
    Wrappers, DamagedWrapper,
    testing::Values(Damage{"unit_axis.v", "spare_valid | out_valid", "out_valid"},
                    Damage{"unit_axis.v", "spare_valid ? spare_hit : out_hit", "out_hit"},
                    Damage{"unit_axis.v", "spare_valid ? spare_tag : out_tag", "out_tag"},
                    Damage{"unit_axis.v", "if (~spare_valid)", "if (1'b1)"}));

/// No input reaches an output in the same cycle.
TEST(Wrappers, StreamHasARegisterOnEveryPath) {
  constexpr const char* bench = R"(module bench;
  reg clk = 0, rst_n = 0, s_valid = 0, m_ready = 0;
  reg [S:0] s_data = 0;
  wire s_ready, m_valid;
  wire [7:0] m_data;
  wire [3:0] m_tid;
  unit_axis #(.TAG_BITS(4)) dut (
    .aclk(clk), .aresetn(rst_n),
    .s_axis_tvalid(s_valid), .s_axis_tready(s_ready), .s_axis_tdata(s_data), .s_axis_tid(s_data[3:0]),
    .m_axis_tvalid(m_valid), .m_axis_tready(m_ready), .m_axis_tdata(m_data), .m_axis_tid(m_tid));
  integer i, j, seed = 1, busy = 0;
  reg [13:0] before;
  initial begin
    repeat (4) begin #5 clk = 1; #5 clk = 0; end
    rst_n = 1;
    for (i = 0; i < 3000; i = i + 1) begin
      for (j = 0; j < 4; j = j + 1) begin
        {s_valid, m_ready} = $random(seed);
        s_data = {8{$random(seed)}} & {S+1{1'b1}};
        #1;
        if (j != 0 && before !== {s_ready, m_valid, m_valid ? {m_data, m_tid} : 12'd0}) begin
          $display("FAIL cycle %0d", i);
          $finish;
        end
        before = {s_ready, m_valid, m_valid ? {m_data, m_tid} : 12'd0};
      end
      if (!s_ready) busy = busy + 1;
      #5 clk = 1; #5 clk = 0;
    end
    $display("PASS, %0d cycles busy", busy);
  end
endmodule
)";
  for (const FlowControl flow : {FlowControl::stall, FlowControl::none}) {
    const EmittedDesign unit =
        emitted({"int_slabs", "6/6"}, {.flow = flow, .axi_stream = true, .interval = 2});
    const ScratchFolder folder;
    host::write_files(folder.path(), unit.files());
    const Json& stream = unit.manifest->at("axi_stream");
    const auto high = [&](const char* side) {
      return std::to_string(stream.at(side).at("tdata_bits").get<int>() - 1);
    };
    std::string text = bench;
    for (const auto& [name, bits] : {std::pair{"[S:0]", "[" + high("s_axis") + ":0]"},
                                     {"{S+1{1'b1}}", "{" + high("s_axis") + "+1{1'b1}}"}})
      text = replaced(text, name, bits);
    write_text(folder / "bench.v", text);
    const std::string said =
        run_tool(folder.path(), "iverilog", "iverilog", "-g2005 -y . -o bench bench.v && vvp -n bench")
            .output;
    EXPECT_THAT(said, testing::MatchesRegex("PASS, [1-9][0-9]+ cycles busy\n")) << said;
  }
}

}  // namespace
}  // namespace hitpipe::rtl::wrappers_test
