// The Vitis HLS script, run with stand-ins for the tool's own commands by the Tcl that is in Yosys: which
// commands it gives, and that the test program it writes passes. The tool itself is not run.
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "host/scratch_folder.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::hls {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* stand_ins = R"(
foreach name {open_project set_top add_files open_solution set_part create_clock csim_design csynth_design
              export_design} {
  proc $name {args} "puts \"> \[join \[linsert \$args 0 $name\]\]\""
}
rename exit leave
proc exit {} { puts "> exit"; leave 0 }
if {[catch {source $::env(SCRIPT)} message]} { puts "> error $message"; leave 1 }
)";

class VitisHls : public testing::Test {
 protected:
  /// Commands that the script gives, settings as a shell writes them.
  std::vector<std::string> commands(const std::string& settings) {
    rtl::write_text(folder / "stand_ins.tcl", stand_ins);
    const rtl::ToolResult result = rtl::run_tool(
        folder.path(), "yosys", "env",
        settings + " SCRIPT='" + HITPIPE_SOURCE + "/hls/top/vitis_hls.tcl' yosys -q -c stand_ins.tcl");
    std::istringstream lines(result.output);
    std::vector<std::string> list;
    std::string line;
    while (std::getline(lines, line)) {
      if (line.starts_with("> ")) list.push_back(line.substr(2));
    }
    return list;
  }
  /// Compiles the written test program with the top it is for, and runs it.
  std::string simulated(const std::string& design, const std::string& flags) {
    const rtl::ToolResult compiled =
        rtl::run_tool(folder.path(), "g++", HITPIPE_CXX,
                      "-std=c++20 -Wall -Wextra -Werror " + flags + " '-I" + HITPIPE_SOURCE + "' hitpipe_" +
                          design + "_csim.cpp '" + HITPIPE_SOURCE + "/hls/top/" + design + ".cpp' -o csim");
    if (compiled.status != 0) return compiled.output;
    const rtl::ToolResult run = rtl::run_tool(folder.path(), "", "./csim", "");
    return run.output + "exit " + std::to_string(run.status);
  }

  host::ScratchFolder folder;
};

TEST_F(VitisHls, GivesTheStepsInOrder) {
  EXPECT_THAT(commands("DESIGN=int_plucker BITS=20/24 PART=some-part CLOCK=4"),
              ElementsAre("open_project -reset hitpipe_int_plucker", "set_top hitpipe_int_plucker",
                          AllOf(StartsWith("add_files "), HasSubstr("hls/top/int_plucker.cpp"),
                                HasSubstr("-DHITPIPE_VENDOR"), HasSubstr("-DHITPIPE_COORD_BITS=20"),
                                HasSubstr("-DHITPIPE_INTERVAL_BITS=24")),
                          AllOf(StartsWith("add_files -tb "), HasSubstr("hitpipe_int_plucker_csim.cpp")),
                          "open_solution -reset solution", "set_part some-part", "create_clock -period 4",
                          "csim_design", "csynth_design", "export_design -format ip_catalog", "exit"));
}

TEST_F(VitisHls, WritesATestProgramThatPassesOnIntegers) {
  ASSERT_EQ(commands("DESIGN=int_plucker BITS=20/24").size(), 11U);
  EXPECT_THAT(simulated("int_plucker", "-DHITPIPE_COORD_BITS=20 -DHITPIPE_INTERVAL_BITS=24"),
              AllOf(HasSubstr("10000 tests"), HasSubstr(" 0 mismatches\nexit 0")));
}

TEST_F(VitisHls, WritesATestProgramThatPassesOnFloats) {
  ASSERT_EQ(commands("DESIGN=fp_slabs").size(), 11U);
  EXPECT_THAT(simulated("fp_slabs", ""), AllOf(HasSubstr("10000 tests"), HasSubstr(" 0 mismatches\nexit 0")));
}

TEST_F(VitisHls, UnknownDesignRejected) {
  EXPECT_THAT(
      commands("DESIGN=no_such"),
      ElementsAre("error DESIGN=no_such: unknown; there are: int_slabs, int_plucker, fp_slabs, fp_plucker"));
}

TEST_F(VitisHls, BadBitsRejected) {
  EXPECT_THAT(commands("BITS=20"), ElementsAre("error BITS=20: allowed is n/t, for example 20/24"));
}

}  // namespace
}  // namespace hitpipe::hls
