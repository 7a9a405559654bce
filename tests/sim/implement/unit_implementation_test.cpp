// Units of small formats in chips and cells: the counts that Yosys and nextpnr make, and netlists that answer
// as the C++ does. No time is compared.
#include "sim/implement/unit_implementation.hpp"

#include <fstream>
#include <iterator>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rtl_gen/component/library.hpp"
#include "rtl_gen/emit/files.hpp"
#include "sim/implement/target.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/environment.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::unit_implementation_test {
namespace {

using testing::StartsWith;

/// A target without placement: what is counted and simulated, in less time.
Target mapped_only(const char* name) {
  Target target = target_called(name);
  target.placer.reset();
  target.not_placed = "not in this test";
  return target;
}

struct Case {
  const char* design;
  const char* bits;
};

class EveryDesign : public testing::TestWithParam<Case> {};

TEST_P(EveryDesign, NetlistInChipCellsAnswersAsTheCpp) {
  const rtl::Design& design = rtl::find_design(GetParam().design);
  const TemporaryFolder folder;
  const Implementation unit =
      implement_unit(design, design.parse_format(GetParam().bits), mapped_only("ice40_hx"),
                     {.folder = folder.path(), .simulate = 1000});
  ASSERT_TRUE(unit.simulated);
  EXPECT_TRUE(unit.simulated->agrees);
  EXPECT_EQ(unit.simulated->said, "PASS 1000 vectors");
}

INSTANTIATE_TEST_SUITE_P(SmallFormats, EveryDesign,
                         testing::Values(Case{"int_slabs", "6/6"}, Case{"int_plucker", "6/6"},
                                         Case{"int_major", "6+0/4"}, Case{"int_major_pair", "6+0/4"},
                                         Case{"fp_slabs_safe", "e3m2"}),
                         [](const auto& each) { return std::string(each.param.design); });

TEST(Implementation, NetlistInStandardCellsAnswersAsTheCpp) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const TemporaryFolder folder;
  const Implementation unit =
      implement_unit(design, design.parse_format("6/6"), target_called("osu018"),
                     {.folder = folder.path(), .flow_control = rtl::FlowControl::stall, .simulate = 1000});
  ASSERT_TRUE(unit.simulated);
  EXPECT_EQ(unit.simulated->said, "PASS 1000 vectors");
  EXPECT_GT(*unit.synthesis.area_um2, 0.0);
  EXPECT_GT(*unit.critical_path_ns, 0.0);
  // The input latches alone are 97 operand bits, the tag and the valid bit.
  EXPECT_GT(unit.count_of("registers")->used, 97 + 16 + 1);
}

/// Yosys 0.23 itself ends with a segmentation fault here. Float units have such products.
TEST(Implementation, UnsignedProductMayBeDelayedByTwoRegisters) {
  const TemporaryFolder folder;
  const Target target = target_called("ice40_up5k");
  const host::File verilog{
      "product.v",
      "module product (input clk, input [15:0] a, input [11:0] b, output reg [27:0] q);\n"
      "  reg [27:0] p;\n"
      "  always @(posedge clk) begin p <= a * b; q <= p; end\n"
      "endmodule\n"};
  const Synthesis synthesis =
      synthesise(target, {"product", {verilog}}, find_chip_tools(target).yosys, Workbench(folder.path()));
  const auto of = [&](const char* cell) {
    const auto at = synthesis.cells.find(cell);
    return at == synthesis.cells.end() ? 0 : at->second;
  };
  EXPECT_EQ(of("SB_MAC16"), 1);
  EXPECT_EQ(of("SB_DFF"), 28);
}

/// The unit of a placement between shift registers has the cells of the unit alone.
TEST(Implementation, PlacesTheNetlistThatItCounts) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const TemporaryFolder folder;
  const Implementation unit =
      implement_unit(design, design.parse_format("8/8"), target_called("ice40_up5k"),
                     {.folder = folder.path(), .module = "box_test", .seeds = 1, .simulate = 1000});
  // Six products, each in a block of the chip.
  EXPECT_EQ(unit.count_of("dsps")->used, 6);
  EXPECT_EQ(unit.simulated->said, "PASS 1000 vectors");
  ASSERT_TRUE(unit.placed);
  ASSERT_EQ(unit.placed->seeds.size(), 1U);
  EXPECT_GT(unit.placed->median().fmax_mhz, 0.0);
  EXPECT_THAT(unit.placed->best().critical.from, StartsWith("unit."));
  EXPECT_THAT(unit.placed->best().critical.to, StartsWith("unit."));
  EXPECT_GE(unit.count_of("logic_cells")->used, unit.count_of("luts")->used);
  for (const char* const name : {"box_test.v", "box_test_netlist.v", "box_test_synthesis.log",
                                 "box_test_harness.v", "box_test_harness_place_1.json"})
    EXPECT_TRUE(std::filesystem::exists(folder.path() / "ice40_up5k" / name)) << name;
}

/// Yosys with what 0.55 does otherwise: it counts cells without hardware that say where modules were, and
/// refuses modules of cells that it read from a netlist. Both lines are from its own output.
constexpr const char* newer_yosys = R"sh(#!/bin/sh
for script; do :; done
case $script in *.ys) ;; *) exec yosys "$@" ;; esac
if grep -q '^read_json' "$script" && ! grep -q '^delete =A:abc9_box$' "$script"; then
  echo "ERROR: Module 'ICE40_CARRY_WRAPPER' with (* abc9_box *) has no timing (and thus no connectivity) information."
  exit 1
fi
yosys "$@" || exit
grep -B1 'stat -json' "$script" | grep -q '^delete t:[$]scopeinfo$' ||
  sed -i 's/^\( *\)"SB_CARRY"/\1"$scopeinfo": 6,\n&/' *_cells.json
)sh";

TEST(Implementation, TakesANewerYosys) {
  const TemporaryFolder tools, folder;
  const EnvironmentValue yosys("YOSYS", tools.write_program("yosys-0.55", newer_yosys).string());
  const rtl::Design& design = rtl::find_design("int_slabs");
  const Implementation unit = implement_unit(design, design.parse_format("6/6"), target_called("ice40_up5k"),
                                             {.folder = folder.path(), .seeds = 1});
  EXPECT_FALSE(unit.synthesis.cells.contains("$scopeinfo"));
  ASSERT_TRUE(unit.placed);
  EXPECT_EQ(unit.placed->seeds.size(), 1U);
}

/// Six products on two blocks, in turn.
TEST(Implementation, ATestEveryThreeCyclesTakesAThirdOfTheBlocks) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const TemporaryFolder folder;
  const Implementation unit =
      implement_unit(design, design.parse_format("8/8"), target_called("ice40_up5k"),
                     {.folder = folder.path(), .interval = 3, .seeds = 0, .simulate = 1000});
  EXPECT_EQ(unit.count_of("dsps")->used, 2);
  EXPECT_EQ(unit.simulated->said, "PASS 1000 vectors");
}

TEST(Implementation, UnitThatDoesNotFitKeepsItsCounts) {
  Target small = target_called("ice40_up5k");
  for (Resource& resource : small.resources)
    if (resource.name == "registers") resource.available = 100;
  const rtl::Design& design = rtl::find_design("int_slabs");
  const TemporaryFolder folder;
  const Implementation unit =
      implement_unit(design, design.parse_format("6/6"), small, {.folder = folder.path()});
  EXPECT_FALSE(unit.placed);
  EXPECT_FALSE(unit.fmax_mhz());
  EXPECT_EQ(unit.excess(), fmt::format("{} of 100 registers", unit.count_of("registers")->used));
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The text behind a label, up to the next closing parenthesis.
std::string after(const std::string& text, const std::string& label, std::size_t from) {
  const std::size_t at = text.find(label, from) + label.size();
  return text.substr(at, text.find(')', at) - at);
}

/// Damages a netlist that was simulated, and simulates it again.
TEST(NetlistSimulation, DamagedNetlistIsFound) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const Format format = design.parse_format("6/6");
  const Target target = mapped_only("ice40_hx");
  const TemporaryFolder folder;
  const Implementation unit =
      implement_unit(design, format, target, {.folder = folder.path(), .simulate = 1000});
  ASSERT_TRUE(unit.simulated->agrees);
  const std::filesystem::path kept = folder.path() / "ice40_hx";
  std::string netlist = contents(kept / unit.synthesis.verilog());
  // The lookup table before HIT's register now says the contrary for half of its inputs.
  const std::string hit = after(netlist, "    .D(", netlist.rfind("SB_DFF", netlist.find(".Q(hit)")));
  const std::size_t at = netlist.rfind(".LUT_INIT(16'h", netlist.find("    .O(" + hit + ")"));
  ASSERT_NE(at, std::string::npos);
  for (const std::size_t digit : {at + 14, at + 16})
    netlist[digit] = fmt::format("{:x}", 15 - std::stoi(netlist.substr(digit, 1), nullptr, 16))[0];

  const Workbench bench(folder.path() / "again");
  bench.put({unit.synthesis.verilog(), netlist});
  const NetlistTestbench testbench{
      {"", contents(kept / "tb" / (unit.module + "_tb.sv"))},
      {unit.module + "_vectors.hex", contents(kept / "tb" / (unit.module + "_vectors.hex"))}};
  const NetlistAnswer answer =
      simulate_netlist(target, unit.synthesis, testbench, find_simulator(Simulator::icarus),
                       find_chip_tools(target).yosys, bench);
  EXPECT_FALSE(answer.agrees);
  EXPECT_THAT(answer.said, StartsWith("FAIL vector "));
}

TEST(Implementation, TargetWithoutModelsIsNotSimulated) {
  const rtl::Design& design = rtl::find_design("int_slabs");
  const TemporaryFolder folder;
  EXPECT_EQ(message_of<std::runtime_error>([&] {
              static_cast<void>(implement_unit(design, design.default_format, target_called("ecp5"),
                                               {.folder = folder.path() / "out", .simulate = 1}));
            }),
            "target ecp5: has no simulation models of its cells, so its netlist cannot be simulated");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "out"));
}

}  // namespace
}  // namespace hitpipe::sim::unit_implementation_test
