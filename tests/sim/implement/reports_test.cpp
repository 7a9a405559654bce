// What the tools print, captured from Yosys 0.23, nextpnr-ice40 0.4 and OpenSTA 2.0.17, and what is read from
// it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/implement/netlist_simulation.hpp"
#include "sim/implement/place_and_route.hpp"
#include "sim/implement/shift_harness.hpp"
#include "sim/implement/synthesis.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::sim::reports_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;

constexpr const char* stat_json = R"text({
   "creator": "Yosys 0.23 (git sha1 7ce5011c24b)",
   "invocation": "stat -json ",
   "modules": {
      "\\u": {
         "num_cells":         1709,
         "num_cells_by_type": {
            "SB_CARRY": 318,
            "SB_DFFE": 731
         }
      }
   },
      "design": {
         "num_wires":         263,
         "num_cells":         1709,
         "num_cells_by_type": {
            "SB_CARRY": 318,
            "SB_DFFE": 731,
            "SB_DFFESR": 5,
            "SB_LUT4": 643,
            "SB_MAC16": 12
         }
      }
}
)text";

TEST(Synthesis, ReadsTheCellsThatYosysCounts) {
  EXPECT_THAT(mapped_cells(stat_json),
              ElementsAre(Pair("SB_CARRY", 318), Pair("SB_DFFE", 731), Pair("SB_DFFESR", 5),
                          Pair("SB_LUT4", 643), Pair("SB_MAC16", 12)));
}

TEST(Synthesis, UnmappedCellRejected) {
  std::string stat = stat_json;
  stat.replace(stat.rfind("SB_LUT4"), 7, "$_DFF_P_");
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(mapped_cells(stat)); }),
            "Yosys left 643 cells $_DFF_P_ without a cell of the target");
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(mapped_cells("Number of cells: 3")); }),
            "Yosys's counts of cells cannot be read");
}

std::vector<std::pair<std::string, int>> counted(const std::string& target, const std::string& resource,
                                                 const std::map<std::string, int>& cells) {
  std::vector<std::pair<std::string, int>> all;
  for (const ResourceCount& count : count_resources(target_called(target), cells))
    if (count.name == resource) all.emplace_back(count.name, count.used);
  return all;
}

TEST(Synthesis, CountsCellsByTheTargetsPatterns) {
  const auto ice40 = mapped_cells(stat_json);
  EXPECT_THAT(counted("ice40_up5k", "registers", ice40), ElementsAre(Pair("registers", 736)));
  EXPECT_THAT(counted("ice40_up5k", "dsps", ice40), ElementsAre(Pair("dsps", 12)));
  // A carry cell of ECP5 takes two lookup tables.
  EXPECT_THAT(counted("ecp5", "luts", {{"LUT4", 522}, {"CCU2C", 168}}), ElementsAre(Pair("luts", 858)));
  EXPECT_THAT(counted("xc7", "luts", {{"LUT2", 109}, {"LUT6", 70}, {"SRL16E", 33}, {"FDRE", 444}}),
              ElementsAre(Pair("luts", 212)));
  EXPECT_THAT(counted("osu018", "registers", {{"DFFPOSX1", 402}, {"INVX1", 275}}),
              ElementsAre(Pair("registers", 402)));
}

TEST(Synthesis, ReadsTheAreaOfCells) {
  EXPECT_EQ(
      cell_area("     XOR2X1                         92\n\n   Chip area for module '\\u': 107305.000000\n"),
      107305.0);
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(cell_area("no area")); }),
            "Yosys printed no cell area");
}

constexpr const char* report = R"({
 "critical_paths": [
  {"from": "posedge clk$SB_IO_IN_$glb_clk", "path": [
    {"delay": 0.54, "from": {"cell": "unit.it_far_y_s3_SB_CARRY_I0_6$CARRY", "loc": [5, 10], "port": "CLK"},
     "to": {"cell": "unit.mul_it_far_x.sum_1_SB_LUT4_O_6_LC", "loc": [4, 9], "port": "O"}, "type": "clk-to-q"},
    {"budget": 0, "delay": 0.588, "from": {"cell": "unit.mul_it_far_x.sum_1_SB_LUT4_O_6_LC", "loc": [4, 9], "port": "O"},
     "net": "unit.it_far_x_s3[0]",
     "to": {"cell": "unit.it_far_y_s3_SB_CARRY_I0_6$CARRY", "loc": [5, 10], "port": "I3"}, "type": "routing"},
    {"delay": 0.335, "from": {"cell": "unit.overlap_SB_LUT4_O_LC", "loc": [9, 11], "port": "I3"},
     "to": {"cell": "unit.overlap_SB_LUT4_O_LC", "loc": [9, 11], "port": "I3"}, "type": "setup"}],
   "to": "posedge clk$SB_IO_IN_$glb_clk"},
  {"from": "posedge shift_clk$SB_IO_IN_$glb_clk", "path": [
    {"delay": 0.54, "from": {"cell": "in_SB_DFF_Q_112_DFFLC", "loc": [12, 9], "port": "CLK"},
     "to": {"cell": "in_SB_DFF_Q_113_DFFLC", "loc": [11, 17], "port": "O"}, "type": "clk-to-q"}],
   "to": "posedge clk$SB_IO_IN_$glb_clk"}
 ],
 "fmax": {
  "clk$SB_IO_IN_$glb_clk": {"achieved": 59.252235412597656, "constraint": 12},
  "shift_clk$SB_IO_IN_$glb_clk": {"achieved": 376.9317626953125, "constraint": 12}
 },
 "utilization": {"ICESTORM_LC": {"available": 7680, "used": 1648}}
})";

TEST(PlaceAndRoute, ReadsFrequencyAndPathOfTheUnitsClock) {
  const PlacedSeed seed = read_report(report, "clk");
  EXPECT_NEAR(seed.fmax_mhz, 59.2522, 1e-4);
  EXPECT_NEAR(seed.critical.logic_ns, 0.875, 1e-9);
  EXPECT_NEAR(seed.critical.routing_ns, 0.588, 1e-9);
  EXPECT_EQ(seed.critical.from, "unit.mul_it_far_x.sum_1_SB_LUT4_O_6_LC");
  EXPECT_EQ(seed.critical.to, "unit.overlap_SB_LUT4_O_LC");
  EXPECT_NEAR(read_report(report, "shift_clk").fmax_mhz, 376.9318, 1e-4);
}

TEST(PlaceAndRoute, ReportWithoutTheClockRejected) {
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(read_report(report, "clock")); }),
            "nextpnr reports no path in the clock clock");
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(read_report("{\"fmax\": ", "clk")); }),
            "nextpnr's report cannot be read");
}

TEST(PlaceAndRoute, ReadsWhatIsUsedAfterPacking) {
  const std::string log =
      "Info: Device utilisation:\n"
      "Info: \t         ICESTORM_LC:   860/ 5280    16%\n"
      "Info: \t        ICESTORM_RAM:     0/   30     0%\n"
      "Info: \t        ICESTORM_DSP:    12/    8   150%\n";
  EXPECT_EQ(packed_count(log, "ICESTORM_LC"), 860);
  EXPECT_EQ(packed_count(log, "ICESTORM_DSP"), 12);
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(packed_count(log, "SB_IO")); }),
            "nextpnr's log does not say how many SB_IO are used");
}

TEST(PlaceAndRoute, TakesMedianAndBestOfTheSeeds) {
  const PlacedDesign odd{{{1, 50, {}}, {2, 70, {}}, {3, 60, {}}}};
  EXPECT_EQ(odd.median().seed, 3);
  EXPECT_EQ(odd.best().seed, 2);
  const PlacedDesign even{{{1, 50, {}}, {2, 70, {}}, {3, 60, {}}, {4, 40, {}}}};
  EXPECT_EQ(even.median().seed, 1);
}

TEST(CellTiming, ReadsTheSlack) {
  EXPECT_NEAR(slack_ns("License GPLv3\nhitpipe slack -1.956821e+02\nStartpoint: _5140_\n"), -195.6821, 1e-9);
  EXPECT_EQ(message_of<std::runtime_error>([] { static_cast<void>(slack_ns("No paths found.\n")); }),
            "OpenSTA found no path from register to register");
}

TEST(ShiftHarness, ConnectsEveryPortButTheClock) {
  const std::string netlist =
      R"({"modules": {"u": {"ports": {"clk": {"direction": "input", "bits": [2]},
          "a": {"direction": "input", "bits": [3, 4, 5]}, "b": {"direction": "input", "bits": [6]},
          "hit": {"direction": "output", "bits": [7]}, "out_tag": {"direction": "output", "bits": [8, 9]}}}}})";
  const std::string harness = shift_harness("u", "clk", ports_of_netlist(netlist, "u"));
  EXPECT_THAT(harness, HasSubstr("module u_harness (\n  input  wire clk,\n  input  wire shift_clk,\n"));
  EXPECT_THAT(harness, HasSubstr("  reg [3:0] operands;\n  wire [2:0] results;\n"));
  EXPECT_THAT(harness,
              HasSubstr("  u unit (\n    .clk(clk),\n    .a(operands[2:0]),\n    .b(operands[3:3]),\n"
                        "    .hit(results[0:0]),\n    .out_tag(results[2:1])\n  );\n"));
  EXPECT_EQ(message_of<std::runtime_error>([&] { static_cast<void>(ports_of_netlist(netlist, "v")); }),
            "Yosys's netlist has no module v");
}

TEST(NetlistSimulation, FailCountsBeforePass) {
  EXPECT_EQ(last_word("VCD info\nPASS 1000 vectors\n"), "PASS 1000 vectors");
  EXPECT_EQ(last_word("FAIL vector 4 (08a6): hit 0, expected 1, tag 4\nFATAL: u_tb.sv:127:\n"),
            "FAIL vector 4 (08a6): hit 0, expected 1, tag 4");
  EXPECT_EQ(last_word("Segmentation fault"), "");
}

}  // namespace
}  // namespace hitpipe::sim::reports_test
