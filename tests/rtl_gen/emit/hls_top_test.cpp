// The top function of a design as text, and the scripts for its tools: run with stand-ins for a tool's own
// commands by the Tcl that is in Yosys, they give the right commands, and the test program beside them
// passes. The tools themselves are not run. tests/hls/top compiles the tops of all designs and compares their
// results.
#include "rtl_gen/emit/hls_top.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hls/box/fp_format.hpp"
#include "hls/box/int_format.hpp"
#include "host/files.hpp"
#include "rtl_gen/emit/vectors.hpp"
#include "tests/message_of.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::rtl::hls_top_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

HlsTop top_of(std::string_view name, std::string_view bits) {
  const Design& design = find_design(name);
  return hls_top(design, design.parse_format(bits), design.module_at(design.parse_format(bits)));
}

constexpr const char* stand_ins = R"(
foreach name {open_project set_top add_files open_solution set_part create_clock csim_design csynth_design
              export_design solution go directive} {
  proc $name {args} "puts \"> \[join \[linsert \$args 0 $name\]\]\""
}
rename exit leave
proc exit {} { puts "> exit"; leave 0 }
if {[catch {source [lindex [glob *_$::env(TOOL).tcl] 0]} message]} { puts "> error $message"; leave 1 }
)";

class HlsTools : public testing::Test {
 protected:
  void write(const HlsTop& top) {
    host::write_files(folder.path(), top.files());
    write_text(folder / "stand_ins.tcl", stand_ins);
  }
  /// Commands that the script of a tool gives, settings as a shell writes them.
  std::vector<std::string> commands(const std::string& tool, const std::string& settings) {
    const ToolResult result = run_tool(folder.path(), "yosys", "env",
                                       "TOOL=" + tool + " " + settings + " yosys -q -c stand_ins.tcl");
    std::istringstream lines(result.output);
    std::vector<std::string> list;
    for (std::string line; std::getline(lines, line);)
      if (line.starts_with("> ")) list.push_back(line.substr(2));
    return list;
  }
  /// What the script prints with a stand-in for Bambu: its arguments one a line, then the test program's
  /// line.
  std::vector<std::string> bambu(const std::string& settings) {
    write_text(
        folder / "bin/bambu",
        "#!/bin/sh\nprintf '%s\\n' \"$@\"\n"
        "mkdir -p HLS_output/simulation\n"
        "printf 'vectors: 9 vectors, 0 mismatches\\n- finish\\n' >HLS_output/simulation/testbench.log\n");
    std::istringstream lines(
        run_tool(folder.path(), "", "env", settings + " PATH=\"$PWD/bin:$PATH\" ./*_bambu.sh").output);
    std::vector<std::string> list;
    for (std::string line; std::getline(lines, line);) list.push_back(line);
    return list;
  }
  /// Compiles the test program with the top that it is for, and runs it on vectors of which half hit.
  std::string simulated(const std::string& design, const Format& format) {
    const std::vector<Port> ports = find_design(design).ports(format);
    DrawVectors draw(ports, {}, find_design(design).evaluate(format), 17);
    std::vector<Vector> vectors;
    for (int i = 0; i < 1000; ++i) vectors.push_back(draw());
    write_text(folder / (design + "_vectors.hex"),
               vector_file(ports, ports, find_design(design).results(format), vectors));
    const ToolResult compiled =
        run_tool(folder.path(), "g++", HITPIPE_CXX,
                 std::string("-std=c++20 -O1 -Wall -Wextra -Wconversion -Wshadow -Werror '-I") +
                     HITPIPE_SOURCE + "' " + design + "_csim.cpp " + design + ".cpp -o csim");
    if (compiled.status != 0) return compiled.output;
    const ToolResult run = run_tool(folder.path(), "", "./csim", "");
    return run.output + "exit " + std::to_string(run.status);
  }

  host::ScratchFolder folder;
  const std::string sources = std::string("INCLUDE='") + HITPIPE_SOURCE + "'";
};

TEST(HlsTop, HeaderIsTheFunctionWithAnArgumentForEachPort) {
  EXPECT_THAT(
      top_of("int_slabs", "20/24").header.contents,
      AllOf(
          StartsWith("// Top function of int_slabs 20/24 for high-level synthesis: integer slabs test, "
                     "figures 7.4-7.6.\n// Written by `hitpipe rtl int_slabs --bits 20/24 --hls`.\n"
                     "#pragma once\n\n#include \"hls/top/top_domain.hpp\"\n\n"
                     "extern \"C\" {\nvoid hitpipe_int_slabs(hitpipe::hls::top::Integer<20> irx, hitpipe::"),
          HasSubstr("hitpipe::hls::top::Bit rinf, "),
          EndsWith("hitpipe::hls::top::Integer<20> izmax, hitpipe::hls::top::Bit& hit);\n}\n")));
}

TEST(HlsTop, SourceSetsOperandsAndReturnsResults) {
  EXPECT_THAT(
      top_of("fp_slabs", "fp32").source.contents,
      AllOf(StartsWith("// One test a cycle: operands are plain ports, taken when the block starts. "),
            HasSubstr("\n#include \"fp_slabs.hpp\"\n\n#if defined(__BAMBU__)"),
            HasSubstr("\n#endif\n#include \"hls/pipelines/fp_slabs.hpp\"\n#if defined(__BAMBU__)\n"
                      "#pragma clang attribute pop\n#endif\n\nusing namespace hitpipe::hls;\n\n"
                      "void hitpipe_fp_slabs(top::Pattern<32> rx, "),
            HasSubstr(", top::Bit& hit) {\n"
                      "#if defined(__BAMBU__) || (defined(__SYNTHESIS__) && !defined(HITPIPE_AC_TYPES))\n"
                      "#pragma HLS PIPELINE II = 1\n#pragma HLS INTERFACE mode = ap_none port = rx\n"),
            HasSubstr("#pragma HLS INTERFACE mode = ap_none port = hit\n#else\n"
                      "#pragma HLS INTERFACE mode = ap_vld port = hit\n#endif\n#endif\n"
                      "  using Format = FpFormat<8, 23>;\n"
                      "  FpSlabs::Operands<top::Domain, Format> in;\n  in.rx.bits = rx;\n"),
            HasSubstr("\n  in.rinf = rinf;\n"),
            EndsWith("  in.zmax.bits = zmax;\n  const auto out = FpSlabs::test<top::Domain>(Format(), in);\n"
                     "  hit = out.hit;\n}\n")));
}

TEST(HlsTop, TellsTheToolsTheInterval) {
  const Design& design = find_design("int_plucker");
  const HlsTop top = hls_top(design, design.default_format, "int_plucker", 3);
  EXPECT_THAT(top.header.contents,
              HasSubstr("// Written by `hitpipe rtl int_plucker --bits 20/24 --ii 3 --hls`."));
  EXPECT_THAT(top.source.contents, StartsWith("// A test every 3 cycles: operands are plain ports"));
  EXPECT_THAT(top.source.contents, HasSubstr("\n#pragma HLS PIPELINE II = 3\n"));
  EXPECT_THAT(top.scripts.at(2).contents,
              HasSubstr("\ndirective set /hitpipe_$module/core/main -PIPELINE_INIT_INTERVAL 3\n"));
  EXPECT_THAT(top.scripts.at(3).contents, HasSubstr(" \"-p=hitpipe_$module=3\" "));
}

TEST(HlsTop, CsimReplaysVectorsThroughTheTop) {
  EXPECT_EQ(
      top_of("int_plucker", "12/12").csim.contents,
      R"(// C simulation of the top function of int_plucker 12/12: replays vectors and compares the results.
//   csim [FILE]    int_plucker_12_12_vectors.hex unless given
#include "hls/top/csim.hpp"
#include "int_plucker_12_12.hpp"

int main(int argc, char** argv) {
  return hitpipe::hls::top::csim(argc, argv, "int_plucker_12_12_vectors.hex", hitpipe_int_plucker_12_12);
}
)");
}

/// A design that does not say where its C++ is has no top function.
std::vector<Design> designs_with_tops() {
  std::vector<Design> all(designs().begin(), designs().end());
  std::erase_if(all, [](const Design& design) { return design.source.pipeline.empty(); });
  return all;
}

TEST(HlsTop, HasEveryPortOfEveryDesignOnce) {
  for (const Design& design : designs_with_tops()) {
    const std::string text = hls_top(design, design.default_format, std::string(design.name)).source.contents;
    for (const Port& port : design.ports(design.default_format))
      EXPECT_EQ(times(text, "ap_none port = " + port.name + "\n"), 1) << design.name << " " << port.name;
    for (const hls::Result& result : design.results(design.default_format))
      for (const char* const mode : {"ap_vld", "ap_none"})
        EXPECT_EQ(times(text, std::string(mode) + " port = " + result.name + "\n"), 1)
            << design.name << result.name;
  }
}

TEST(HlsTop, SeveralResultsAreArgumentsOfTheirKinds) {
  Design toy = find_design("int_slabs");
  toy.results_at = [](const Format&) {
    return std::vector<hls::Result>{{"hit", hls::Meaning::hit, 0, 1, false},
                                    {"entry", hls::Meaning::entry, 0, 24, true},
                                    {"steps", hls::Meaning::exit, 0, 7, false}};
  };
  const std::string text = hls_top(toy, hls::IntBits{20, 24}, "int_slabs").source.contents;
  EXPECT_THAT(text, HasSubstr("top::Bit& hit"));
  EXPECT_THAT(text, HasSubstr("top::Integer<24>& entry"));
  EXPECT_THAT(text, HasSubstr("top::Pattern<7>& steps"));
  EXPECT_THAT(text, EndsWith("  hit = out.hit;\n  entry = out.entry;\n  steps = out.steps;\n}\n"));
}

TEST(HlsTop, IsFormattedAsTheProjectIs) {
  const host::ScratchFolder folder;
  for (const Design& design : designs_with_tops())
    host::write_files(folder.path(),
                      hls_top(design, design.default_format, std::string(design.name)).files());
  expect_silence(folder.path(), "clang-format",
                 "--dry-run --Werror --style='file:" HITPIPE_SOURCE "/.clang-format' *.cpp *.hpp");
}

TEST(HlsTop, DesignThatDoesNotSayWhereItsCodeIsRejected) {
  Design toy = find_design("int_slabs");
  toy.source = {};
  EXPECT_EQ(message_of([&] { return hls_top(toy, toy.default_format, "int_slabs"); }),
            "int_slabs: no top function for high-level synthesis; the design does not say where its C++ is");
}

TEST_F(HlsTools, VitisHlsGetsTheStepsInOrder) {
  write(top_of("int_plucker", "20/24"));
  EXPECT_THAT(
      commands("vitis_hls", sources + " PART=some-part CLOCK=4"),
      ElementsAre("open_project -reset hitpipe_int_plucker", "set_top hitpipe_int_plucker",
                  AllOf(StartsWith("add_files "), HasSubstr("/int_plucker.cpp -cflags"),
                        HasSubstr(std::string("-std=c++14 -I") + HITPIPE_SOURCE + " -DHITPIPE_VENDOR")),
                  AllOf(StartsWith("add_files -tb "), HasSubstr("/int_plucker_csim.cpp -cflags")),
                  AllOf(StartsWith("add_files -tb "), EndsWith("/tb/int_plucker_vectors.hex")),
                  "open_solution -reset solution", "set_part some-part", "create_clock -period 4",
                  AllOf(StartsWith("csim_design -argv "), EndsWith("/tb/int_plucker_vectors.hex")),
                  "csynth_design", "export_design -format ip_catalog", "exit"));
}

TEST_F(HlsTools, CatapultGetsTheStepsInOrder) {
  write(top_of("int_plucker", "20/24"));
  const std::vector<std::string> given = commands("catapult", sources + " CLOCK=4");
  EXPECT_THAT(given,
              ElementsAre("solution new -state initial", "solution options defaults",
                          "solution options set /Input/CppStandard c++14",
                          "solution options set /Input/CompilerFlags -DHITPIPE_AC_TYPES",
                          std::string("solution options set /Input/SearchPath ") + HITPIPE_SOURCE,
                          AllOf(StartsWith("solution file add "), EndsWith("/int_plucker.cpp -type C++")),
                          AllOf(StartsWith("solution file add "),
                                EndsWith("/int_plucker_csim.cpp -type C++ -exclude true")),
                          "go analyze", "directive set -DESIGN_HIERARCHY hitpipe_int_plucker", "go compile",
                          StartsWith("solution library add nangate-45nm_beh -- -rtlsyntool"), "go libraries",
                          "directive set -CLOCKS clk {-CLOCK_PERIOD 4}", "go assembly",
                          "directive set /hitpipe_int_plucker/core/main -PIPELINE_INIT_INTERVAL 1",
                          "go architect", "go extract"));
}

TEST_F(HlsTools, BambuGetsItsOptions) {
  write(top_of("int_plucker", "20/24"));
  const std::string hls = folder.path().string();
  EXPECT_THAT(
      bambu(sources + " DEVICE=some-device CLOCK=4"),
      ElementsAre(hls + "/int_plucker.cpp", "--top-fname=hitpipe_int_plucker", "--generate-interface=INFER",
                  std::string("-I") + HITPIPE_SOURCE, "-DHITPIPE_AC_TYPES", "--std=c++14",
                  "--compiler=I386_CLANG16", "-O3", "-p=hitpipe_int_plucker=1", "--device=some-device",
                  "--clock-period=4", "--simulate", "--simulator=VERILATOR",
                  "--generate-tb=" + hls + "/int_plucker_csim.cpp",
                  "--tb-arg=" + hls + "/../tb/int_plucker_vectors.hex", "vectors: 9 vectors, 0 mismatches"));
  EXPECT_TRUE(std::filesystem::is_directory(folder / "hitpipe_int_plucker"));
}

TEST_F(HlsTools, UnifiedVitisReadsFilesThatAreThere) {
  const HlsTop top = top_of("int_plucker", "12/12");
  write(top);
  std::istringstream lines(top.scripts.at(1).contents);
  std::vector<std::string> files;
  for (std::string line; std::getline(lines, line);) {
    for (const std::string key : {"syn.file=", "tb.file="})
      if (line.starts_with(key)) files.push_back(line.substr(key.size()));
  }
  EXPECT_THAT(files, ElementsAre("int_plucker_12_12.cpp", "int_plucker_12_12_csim.cpp",
                                 "../tb/int_plucker_12_12_vectors.hex"));
  for (int i = 0; i < 2; ++i)
    EXPECT_TRUE(std::filesystem::exists(folder / files[static_cast<std::size_t>(i)]));
  EXPECT_THAT(top.scripts.at(1).contents, HasSubstr("syn.top=hitpipe_int_plucker_12_12\n"));
}

TEST_F(HlsTools, FolderWithoutTheHeadersRejected) {
  write(top_of("int_plucker", "20/24"));
  for (const char* const tool : {"vitis_hls", "catapult"}) {
    EXPECT_THAT(commands(tool, "INCLUDE=/nowhere"),
                ElementsAre("error INCLUDE=/nowhere: there is no hls/top/top_domain.hpp in that folder"));
  }
  EXPECT_THAT(bambu("INCLUDE=/nowhere"),
              ElementsAre("INCLUDE=/nowhere: there is no hls/top/top_domain.hpp in that folder"));
}

TEST_F(HlsTools, TestProgramPasses) {
  write(top_of("fp_slabs", "fp32"));
  EXPECT_THAT(simulated("fp_slabs", hls::Binary32{}), EndsWith("1000 vectors, 0 mismatches\nexit 0"));
}

TEST_F(HlsTools, TestProgramFindsAWrongTop) {
  HlsTop top = top_of("int_slabs", "20/24");
  top.source.contents = replaced(top.source.contents, "in.ixmin = ixmin;", "in.ixmin = ixmin + ixmax;");
  write(top);
  EXPECT_THAT(simulated("int_slabs", hls::IntBits{20, 24}), HasSubstr("mismatches\nexit 1"));
}

}  // namespace
}  // namespace hitpipe::rtl::hls_top_test
