// Units for chips, in the Verilog that tools read: Yosys maps each product to as few multiplier blocks as
// planned, with their registers inside. Tools are silent, and Icarus gets the right answers.
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "area_model/price.hpp"
#include "host/files.hpp"
#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/files.hpp"
#include "rtl_gen/verilog/module.hpp"
#include "tests/rtl_gen/catalogue/formats.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::chips_test {
namespace {

struct Mapped {
  std::string library;
  std::string format;
  int blocks;
  std::string registers;  ///< of the block, as a pattern of the netlist
  std::string design = "int_slabs";
};
void PrintTo(const Mapped& mapped, std::ostream* out) {
  *out << mapped.library << ' ' << mapped.format;
}

/// The first steps of Yosys for a chip, up to the one that takes multiplier blocks.
std::string steps(const std::string& library) {
  if (library == "xc7") return "synth_xilinx -flatten -run begin:coarse";
  if (library == "ecp5") return "synth_ecp5 -run begin:map_ram";
  return "synth_ice40 -dsp -run begin:map_ram";
}

class Chips : public testing::TestWithParam<Mapped> {};

TEST_P(Chips, YosysTakesAsManyBlocksAsPlanned) {
  const Library library = library_called(GetParam().library);
  const Design& design = find_design(GetParam().design);
  const Format format = design.parse_format(GetParam().format);
  const Pipeline pipeline = make_pipeline(design.trace(format), library);
  const std::string block = library.chip()->block->name;
  const ScratchFolder folder;
  write_text(folder / "unit.v", to_verilog(pipeline, library, {.module_name = "unit", .bits = {}}));
  const ToolResult yosys = run_tool(folder.path(), "yosys", "yosys",
                                    "-q -p 'read_verilog unit.v; " + steps(GetParam().library) +
                                        " -top unit; select -write blocks.txt t:" + block +
                                        "; write_verilog -selected netlist.v'");
  ASSERT_EQ(yosys.status, 0) << yosys.output;
  const std::string list = read_text(folder / "blocks.txt");
  EXPECT_EQ(std::count(list.begin(), list.end(), '\n'), GetParam().blocks);
  EXPECT_EQ(area::price(pipeline, design, format, library).taken.blocks, GetParam().blocks);
  if (GetParam().registers.empty()) return;
  const std::string netlist = read_text(folder / "netlist.v");
  const std::regex pattern(GetParam().registers);
  EXPECT_EQ(std::distance(std::sregex_iterator(netlist.begin(), netlist.end(), pattern), {}),
            GetParam().blocks);
}

// Of 7-series blocks: both operands, the partial products and the product are latched in the block. iCE40:
// the operands and the product. No pass of Yosys 0.23 puts registers into the blocks of an ECP5.
INSTANTIATE_TEST_SUITE_P(
    Counts, Chips,
    testing::Values(Mapped{"xc7", "12/12", 6, R"(\.MREG\(1'h1\),\s*\.OPMODEREG[^,]*,\s*\.PREG\(1'h1\))"},
                    Mapped{"xc7", "16/16", 6, R"(\.AREG\(32'd[12]\),[^;]*?\.BREG\(32'd[12]\))"},
                    Mapped{"xc7", "20/24", 6, ""}, Mapped{"xc7", "24/24", 12, ""},
                    Mapped{"ecp5", "16/16", 6, ""}, Mapped{"ecp5", "20/24", 6, ""},
                    Mapped{"ice40_up5k", "16/16", 6, R"(\.A_REG\(1'h1\))"},
                    Mapped{"ice40_up5k", "12/12", 6, R"(\.TOPOUTPUT_SELECT\(2'h1\))"},
                    Mapped{"ice40_up5k", "20/24", 6, ""}, Mapped{"xc7", "e8m15", 6, "", "fp_slabs_safe"},
                    Mapped{"ecp5", "e8m15", 6, "", "fp_slabs_safe"},
                    Mapped{"ice40_up5k", "e8m15", 6, "", "fp_slabs_safe"}),
    [](const auto& each) {
      std::string name = each.param.library + "_" + each.param.format;
      std::replace(name.begin(), name.end(), '/', '_');
      return name;
    });

/// A chip and a unit of every kind: of products in blocks, of products cut into pieces, and of floats.
class ChipUnit : public testing::TestWithParam<std::pair<const char*, DesignFormat>> {
 protected:
  void SetUp() override {
    const auto& [name, unit] = GetParam();
    const Library library = library_called(name);
    const Pipeline pipeline = make_pipeline(unit.found().trace(unit.parsed()), library);
    host::write_files(folder.path(), emit(make_unit(unit.found(), unit.parsed(), library, pipeline)).files());
  }
  const std::string module = GetParam().second.module();
  ScratchFolder folder;
};

TEST_P(ChipUnit, PassesInIcarusAndToolsAreSilent) {
  const ToolResult lint =
      run_tool(folder.path(), "verilator", "verilator", "--lint-only -Wall " + module + ".v");
  EXPECT_EQ(lint.output, "");
  const ToolResult compiled = run_tool(folder.path(), "iverilog", "iverilog",
                                       "-g2012 -Wall -o tb.vvp tb/" + module + "_tb.sv " + module + ".v");
  EXPECT_EQ(compiled.output, "");
  const ToolResult run = run_tool(folder / "tb", "iverilog", "vvp", "-n ../tb.vvp");
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.output, testing::HasSubstr("PASS 1000 vectors"));
}

INSTANTIATE_TEST_SUITE_P(Units, ChipUnit,
                         testing::Values(std::pair{"xc7", DesignFormat{"int_slabs", "24/24"}},
                                         std::pair{"ecp5", DesignFormat{"int_major", "20+1/13"}},
                                         std::pair{"ice40_up5k", DesignFormat{"int_slabs", "20/24"}},
                                         std::pair{"ice40_hx", DesignFormat{"int_plucker", "6/6"}},
                                         std::pair{"xc7", DesignFormat{"fp_slabs", "fp32"}},
                                         std::pair{"xc7", DesignFormat{"fp_slabs_safe", "e8m15"}}),
                         [](const auto& each) {
                           return std::string(each.param.first) + "_" + each.param.second.design;
                         });

/// A register takes a cell of its own in iCE40.
TEST(ChipClock, TheUsualOneIsLongerWhereThatSavesCells) {
  const Design& design = find_design("int_major_pair");
  const Graph graph = design.trace(design.default_format);
  const Library ice40 = library_called("ice40_up5k");
  const int shortest = shortest_clock_ps(graph, ice40);
  const Pipeline usual = make_pipeline(graph, ice40);
  EXPECT_GT(usual.schedule.clock_ps, shortest);
  EXPECT_LE(usual.schedule.clock_ps, shortest * 5 / 4);
  const auto cells_times_time = [&](const Pipeline& p) {
    return area::price(p, design, design.default_format, ice40).logic_cells.value() * p.schedule.clock_ps;
  };
  EXPECT_LT(cells_times_time(usual), cells_times_time(make_pipeline(graph, ice40, shortest)));
  for (const char* const name : {"ecp5", "thesis_250nm"}) {
    const Library other = library_called(name);
    EXPECT_EQ(make_pipeline(graph, other).schedule.clock_ps, shortest_clock_ps(graph, other)) << name;
  }
}

TEST(ChipClock, ALongerOneTakesStagesOutOfFloatOperatorsAndAnswersAlike) {
  const Library library = library_called("ice40_up5k");
  const DesignFormat unit{"fp_slabs_safe", "e5m10"};
  const Pipeline quick = make_pipeline(unit.found().trace(unit.parsed()), library);
  const Pipeline slow = make_pipeline(unit.found().trace(unit.parsed()), library, 100'000);
  EXPECT_LT(2 * slow.latency(), quick.latency());
  const auto registers = [&](const Pipeline& p) {
    return area::price(p, unit.found(), unit.parsed(), library).taken.registers;
  };
  EXPECT_LT(2 * registers(slow), registers(quick));
  const ScratchFolder folder;
  host::write_files(folder.path(), emit(make_unit(unit.found(), unit.parsed(), library, slow)).files());
  const std::string module = unit.module();
  const ToolResult compiled = run_tool(folder.path(), "iverilog", "iverilog",
                                       "-g2012 -Wall -o tb.vvp tb/" + module + "_tb.sv " + module + ".v");
  EXPECT_EQ(compiled.output, "");
  EXPECT_THAT(run_tool(folder / "tb", "iverilog", "vvp", "-n ../tb.vvp").output,
              testing::HasSubstr("PASS 1000 vectors"));
}

}  // namespace
}  // namespace hitpipe::rtl::chips_test
