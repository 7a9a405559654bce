// `hitpipe rtl`: writes a design's files into the given folder and lists them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "rtl_gen/emit/files.hpp"
#include "sim/vectors/design_vectors.hpp"
#include "tests/cli/program.hpp"

namespace hitpipe::cli::rtl_command_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

const std::vector<std::string> all_files{"int_slabs.core",
                                         "int_slabs.json",
                                         "int_slabs.v",
                                         "int_slabs_stage_1.dot",
                                         "int_slabs_stage_1.svg",
                                         "int_slabs_stage_4.dot",
                                         "int_slabs_stage_4.svg",
                                         "int_slabs_stages_2-3.dot",
                                         "int_slabs_stages_2-3.svg",
                                         "tb/Makefile",
                                         "tb/int_slabs_harness.cpp",
                                         "tb/int_slabs_tb.sv",
                                         "tb/int_slabs_vectors.hex"};

class RtlCommand : public testing::Test {
 protected:
  sim::TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_.path() / "a" / "fresh" / "folder";
};

TEST_F(RtlCommand, WritesAllFilesIntoAFreshFolder) {
  const Outcome outcome = run_hitpipe({"rtl", "int_slabs", "--bits", "20/24", "--out", out_.string()});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_EQ(files_below(out_), all_files);
  const hls::IntBits bits{20, 24};
  const rtl::Design& design = rtl::find_design("int_slabs");
  const rtl::Library& library = rtl::Library::thesis();
  const rtl::VectorSet vectors = sim::design_vectors(design, bits, sim::usual_vectors, sim::usual_seed);
  for (const rtl::File& file :
       rtl::emit(rtl::make_unit(design, bits, library), {.vectors = &vectors}).files()) {
    if (file.name == "int_slabs.json") continue;  // it also lists the pictures
    EXPECT_EQ(contents_of(out_ / file.name), file.contents) << file.name;
  }
  EXPECT_THAT(contents_of(out_ / "int_slabs_stage_1.svg"), HasSubstr("</svg>"));
}

TEST_F(RtlCommand, PrintsStagesClockAndFiles) {
  const Outcome outcome = run_hitpipe({"rtl", "int_slabs", "--out", out_.string()});
  EXPECT_EQ(outcome.exit_code, 0);
  std::string expected =
      "design        int_slabs\n"
      "bits          20/24\n"
      "module        int_slabs\n"
      "stages        4\n"
      "latency       4\n"
      "flow_control  stall\n"
      "clock_ps      3,176\n"
      "library       thesis_250nm\n"
      "vectors       6,000\n";
  const char* label = "files         ";
  for (const char* file : {"int_slabs.v", "int_slabs.json", "int_slabs.core", "tb/int_slabs_tb.sv",
                           "tb/int_slabs_harness.cpp", "tb/Makefile", "tb/int_slabs_vectors.hex",
                           "int_slabs_stage_1.dot", "int_slabs_stages_2-3.dot", "int_slabs_stage_4.dot",
                           "int_slabs_stage_1.svg", "int_slabs_stages_2-3.svg", "int_slabs_stage_4.svg"}) {
    expected += label + (out_ / file).string() + "\n";
    label = "              ";
  }
  EXPECT_EQ(outcome.out, expected);
}

TEST_F(RtlCommand, WritesTheAxiStreamWrapperOnlyWhenAsked) {
  ASSERT_EQ(run_hitpipe({"rtl", "int_slabs", "--out", out_.string()}).exit_code, 0);
  const std::string bare = contents_of(out_ / "int_slabs.v");
  EXPECT_FALSE(std::filesystem::exists(out_ / "int_slabs_axis.v"));
  const Outcome outcome =
      run_hitpipe({"rtl", "int_slabs", "--axi-stream", "--flow-control", "stall", "--out", out_.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr((out_ / "int_slabs_axis.v").string() + "\n"));
  EXPECT_THAT(contents_of(out_ / "int_slabs_axis.v"), HasSubstr("module int_slabs_axis #("));
  EXPECT_EQ(contents_of(out_ / "int_slabs.v"), bare);
}

TEST_F(RtlCommand, AWrapperIsAroundAUnitWithoutFlowControlUnlessToldOtherwise) {
  for (const char* const wrapper : {"--axi-stream", "--fifo"}) {
    const std::filesystem::path folder = out_ / wrapper;
    const Outcome outcome = run_hitpipe({"rtl", "int_slabs", wrapper, "--out", folder.string()});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("flow_control  none\n"));
    EXPECT_EQ(nlohmann::json::parse(contents_of(folder / "int_slabs.json")).at("flow_control"), "none");
    EXPECT_THAT(contents_of(folder / "int_slabs.v"), testing::Not(HasSubstr("ready")));
    EXPECT_THAT(contents_of(folder / "int_slabs_fifo.v"), HasSubstr("module int_slabs_fifo #("));
    EXPECT_EQ(std::filesystem::exists(folder / "int_slabs_axis.v"), wrapper == std::string("--axi-stream"));
  }
}

TEST_F(RtlCommand, WritesTheTopFunctionOnlyWhenAsked) {
  const Outcome outcome =
      run_hitpipe({"rtl", "int_slabs", "--bits", "20/24", "--hls", "--out", out_.string()});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  std::vector<std::string> expected = all_files;
  expected.insert(
      std::find(expected.begin(), expected.end(), "int_slabs.core"),
      {"hls/int_slabs.cpp", "hls/int_slabs.hpp", "hls/int_slabs_bambu.sh", "hls/int_slabs_catapult.tcl",
       "hls/int_slabs_csim.cpp", "hls/int_slabs_hls.cfg", "hls/int_slabs_vitis_hls.tcl"});
  EXPECT_EQ(files_below(out_), expected);
  EXPECT_THAT(outcome.out, HasSubstr((out_ / "hls/int_slabs.cpp").string() + "\n"));
  EXPECT_THAT(contents_of(out_ / "hls/int_slabs.cpp"), HasSubstr("using Format = IntFormat<20, 24>;"));
}

TEST_F(RtlCommand, NamesTheUnitAsTold) {
  const Outcome outcome = run_hitpipe({"rtl", "int_slabs", "--bits", "6/6", "--name", "box_test", "--out",
                                       out_.string(), "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(nlohmann::json::parse(outcome.out).at("module"), "box_test");
  EXPECT_THAT(contents_of(out_ / "box_test.v"), HasSubstr("\nmodule box_test #("));
  EXPECT_THAT(contents_of(out_ / "box_test.core"),
              testing::ContainsRegex("\"hitpipe:ray_box:box_test:[0-9]+\\.[0-9]+\\.[0-9]+\""));
  ASSERT_EQ(run_hitpipe({"rtl", "int_slabs", "--bits", "6/6", "--out", out_.string()}).exit_code, 0);
  EXPECT_TRUE(std::filesystem::exists(out_ / "int_slabs_6_6.v"));
  EXPECT_TRUE(std::filesystem::exists(out_ / "box_test.v"));
}

TEST_F(RtlCommand, NameThatIsNoneRejected) {
  for (const char* const name : {"", "2a", "../a", "module"}) {
    const Outcome outcome = run_hitpipe({"rtl", "int_slabs", "--name", name, "--out", out_.string()});
    EXPECT_NE(outcome.exit_code, 0) << name;
    EXPECT_THAT(outcome.err, StartsWith("hitpipe: name " + std::string(name) + ": "));
    EXPECT_EQ(lines_of(outcome.err).size(), 1U);
    EXPECT_FALSE(std::filesystem::exists(out_));
  }
}

TEST_F(RtlCommand, WithoutGraphvizSaysThatItDoesNotDraw) {
  const Outcome outcome = run_hitpipe({"rtl", "int_slabs", "--out", out_.string()}, {{"PATH", "/nowhere"}});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err,
            "hitpipe: the schematics are .dot files only, because Graphviz's dot was not found; install the "
            "package graphviz\n");
  EXPECT_TRUE(std::filesystem::exists(out_ / "int_slabs_stage_1.dot"));
  EXPECT_FALSE(std::filesystem::exists(out_ / "int_slabs_stage_1.svg"));
}

TEST_F(RtlCommand, WritesAsManyVectorsAsAsked) {
  const std::filesystem::path file = out_ / "tb/int_slabs_vectors.hex";
  const auto vectors_of = [&](const std::string& count, const std::string& seed) {
    EXPECT_EQ(run_hitpipe({"rtl", "int_slabs", "--vectors", count, "--seed", seed, "--out", out_.string()})
                  .exit_code,
              0);
    return contents_of(file);
  };
  const std::string few = vectors_of("300", "7");
  EXPECT_THAT(
      few,
      StartsWith("// SPDX-License-Identifier: 0BSD\n// int_slabs 20/24: 300 vectors of seed 7, of which "));
  const auto lines = lines_of(few);
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(), [](const auto& l) { return !l.starts_with("//"); }),
            300);
  EXPECT_THAT(contents_of(out_ / "tb/int_slabs_tb.sv"), HasSubstr("COUNT = 300;"));
  EXPECT_EQ(vectors_of("300", "7"), few);
  EXPECT_NE(vectors_of("300", "8"), few);
}

TEST_F(RtlCommand, SlowerClockTakesFewerStages) {
  const Outcome outcome =
      run_hitpipe({"rtl", "int_slabs", "--out", out_.string(), "--clock-ps", "5000", "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto object = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(object.at("clock_ps"), 5000);
  EXPECT_LT(object.at("stages"), 4);
  EXPECT_THAT(contents_of(out_ / "int_slabs.v"), HasSubstr("Clock of 5000 ps"));
}

/// For every built-in chip the unit of every design is written.
TEST_F(RtlCommand, WritesUnitsForEveryLibrary) {
  for (const std::string library : {"ecp5", "ice40_hx", "ice40_up5k", "xc7"}) {
    for (const rtl::Design& design : rtl::designs()) {
      const Outcome outcome = run_hitpipe({"rtl", std::string(design.name), "--library", library, "--vectors",
                                           "10", "--format", "json", "--out", out_.string()},
                                          {{"PATH", "/nowhere"}});  // drawing takes most of the time
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
      EXPECT_EQ(nlohmann::json::parse(outcome.out).at("library"), library);
      EXPECT_THAT(contents_of(out_ / (std::string(design.name) + ".v")),
                  HasSubstr("the components of " + library));
    }
  }
}

TEST_F(RtlCommand, UsesALibraryOfTheUsersOwn) {
  std::string library =
      contents_of(std::filesystem::path(HITPIPE_SOURCE) / "rtl_gen/component/libraries/thesis_250nm.json");
  const std::string name = "thesis_250nm";
  ASSERT_NE(library.find(name), std::string::npos);
  library.replace(library.find(name), name.size(), "my_own");
  const std::string file = folder_.write("library.json", library).string();
  ASSERT_EQ(run_hitpipe({"rtl", "int_slabs", "--out", out_.string(), "--library", file}).exit_code, 0);
  EXPECT_THAT(contents_of(out_ / "int_slabs.v"), HasSubstr("the components of my_own"));
}

}  // namespace
}  // namespace hitpipe::cli::rtl_command_test
