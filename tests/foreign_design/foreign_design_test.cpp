// A design with formats, operands and arithmetic of its own goes through every command by the same code as
// hitpipe's own. One that lacks a part is refused where it is asked for, and left out with a line where all
// designs are.
#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class ForeignDesign : public testing::Test {
 protected:
  [[nodiscard]] std::string out(const std::string& name) const { return (folder_.path() / name).string(); }
  [[nodiscard]] static json of(const Outcome& run) {
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return json::parse(run.out);
  }

 private:
  sim::TemporaryFolder folder_;
};

TEST_F(ForeignDesign, IsListed) {
  EXPECT_THAT(hitpipe("list designs").out, HasSubstr("block_slabs"));
}

TEST_F(ForeignDesign, IsEmitted) {
  const json emitted =
      of(run_hitpipe({"rtl", "block_slabs", "--bits", "b13m7", "--out", out("rtl"), "--format", "json"}));
  EXPECT_EQ(emitted.at("bits"), "b13m7");
  EXPECT_TRUE(std::filesystem::exists(out("rtl/block_slabs_b13m7.v")));
  EXPECT_TRUE(std::filesystem::exists(out("rtl/block_slabs_b13m7_stage_1.svg")));
}

TEST_F(ForeignDesign, IsPricedBelowTheUnitWithEnds) {
  const json prices = of(run_hitpipe({"area", "int_slabs", "block_slabs", "--format", "json"}));
  ASSERT_EQ(prices.size(), 2U);
  EXPECT_LT(prices[1].at("area_mm2"), prices[0].at("area_mm2"));
  EXPECT_EQ(prices[1].at("bits"), "b16m10");
}

TEST_F(ForeignDesign, HasNoPrintedAccount) {
  const Outcome run = run_hitpipe({"area", "block_slabs", "--account", "printed"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.err,
            "hitpipe: design block_slabs: not in Table 7.2, so there is no printed account of it, only the "
            "built one\n");
}

TEST_F(ForeignDesign, HasFormatsOfItsOwn) {
  const Outcome run = run_hitpipe({"rtl", "block_slabs", "--bits", "b16m16", "--out", out("rtl")});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(
      run.err,
      "hitpipe: bits b16m16: no format of block_slabs; allowed is bNmM with N in 6..24 and M in 4..N-1, "
      "for example b16m10\n");
}

TEST_F(ForeignDesign, IsCosimulated) {
  const json run = of(run_hitpipe({"cosim", "block_slabs", "--scene", "waves", "--width", "24", "--height",
                                   "24", "--referee", "--format", "json"}));
  EXPECT_GT(run.at("hits"), 0);
  for (const char* const wrong : {"rtl_mismatches", "false_misses", "different_triangles"})
    EXPECT_EQ(run.at(wrong), 0) << wrong;
  // It never hears that a closer triangle was found.
  EXPECT_GT(run.at("extra_box_tests_pct"), 1.0);
}

TEST_F(ForeignDesign, IsChecked) {
  const json rows = of(run_hitpipe(
      {"check", "block_slabs", "--bits", "b12m6", "--tests", "27000", "--rtl", "--format", "json"}));
  const json& all = rows.back();
  EXPECT_EQ(all.at("tests"), 27000);
  EXPECT_GT(all.at("exact_hits"), 1000);
  EXPECT_EQ(all.at("false_misses"), 0);
  EXPECT_EQ(all.at("rtl_mismatches"), 0);
}

TEST_F(ForeignDesign, IsAmongTheStiffOnesUnlessOthersAreNamed) {
  const Outcome run = hitpipe("check --stiff --bits 12/12 --tests 600");
  EXPECT_EQ(run.exit_code, 0);
  for (const char* const design : {"int_slabs: ", "int_plucker: ", "block_slabs: "})
    EXPECT_THAT(run.out, HasSubstr(design));
  EXPECT_EQ(
      run.err,
      "hitpipe: design one_axis_slab: there is no set-up of rays and boxes for its operands; left out\n");
}

TEST_F(ForeignDesign, IsSwept) {
  const std::vector<std::string> arguments{"sweep",
                                           "--scene",
                                           "waves",
                                           "--width",
                                           "16",
                                           "--height",
                                           "16",
                                           "--bits",
                                           "fp_slabs=fp32,12/12,b12m6",
                                           "block_slabs,fp_slabs,int_slabs",
                                           "--out",
                                           out("rows.csv"),
                                           "--format",
                                           "json"};
  const json rows = of(run_hitpipe(arguments));
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[2].at("design"), "block_slabs");
  EXPECT_GE(rows[2].at("box_tests"), rows[1].at("box_tests"));
  EXPECT_EQ(of(run_hitpipe(arguments)), rows) << "resumed";
  // It fills every column but those of its set-up's divisions, of which it says nothing, and of a tracer of its own,
  // which it lacks.
  std::vector<std::string> empty;
  for (const auto& [column, cell] : rows[2].items())
    if (cell.is_null()) empty.push_back(column);
  EXPECT_THAT(empty,
              testing::UnorderedElementsAre("set_up_divisions", "set_up_run_time_ms", "software_s_per_mray",
                                            "software_s_per_mray_low", "software_s_per_mray_high"));
  EXPECT_GT(rows[1].at("software_s_per_mray"), 0.0);
  EXPECT_GT(rows[2].at("bytes_per_ray_4kib"), 0.0);
  EXPECT_GT(rows[2].at("energy_pj_per_box"), 0.0);
}

TEST_F(ForeignDesign, IsFitted) {
  const json rows =
      of(run_hitpipe({"fit", "--scene", "waves", "block_slabs", "--width", "16", "--height", "16",
                      "--overhead", "100", "--vectors", "20000", "--out", out("fit"), "--format", "json"}));
  const json& fitted = rows.front();
  EXPECT_GT(fitted.at("area_saved_pct"), 1.0);
  EXPECT_EQ(fitted.at("ray_ends"), true) << "it has none to leave out";
  for (const char* const wrong :
       {"rtl_mismatches", "vector_mismatches", "false_misses", "different_triangles"})
    EXPECT_EQ(fitted.at(wrong), 0) << wrong;
  const json again = of(run_hitpipe({"cosim", "block_slabs", "--unit", out("fit/block_slabs"), "--scene",
                                     "waves", "--width", "16", "--height", "16", "--format", "json"}));
  EXPECT_EQ(again.at("bits"), fitted.at("bits"));
}

TEST_F(ForeignDesign, IsReported) {
  const Outcome run =
      run_hitpipe({"report", "--scene", "waves", "--width", "16", "--height", "16", "--bits",
                   "12/12,12+1/10,b12m8", "--image-design", "block_slabs", "--image-bits", "b12m8", "--tests",
                   "500", "--without", "core,fit", "--out", out("report")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  const std::string page = contents_of(out("report/index.html"));
  EXPECT_THAT(page, HasSubstr("block_slabs b12m8"));
  EXPECT_THAT(contents_of(out("report/rows.csv")), HasSubstr("block_slabs"));
}

/// A report of one design looks at that design alone.
TEST_F(ForeignDesign, IsReportedAlone) {
  const Outcome run = run_hitpipe(
      {"report",  "block_slabs", "--scene",     "waves",          "--width",     "16",           "--height",
       "16",      "--bits",      "b12m6,b12m8", "--image-design", "block_slabs", "--image-bits", "b12m8",
       "--tests", "500",         "--without",   "core,fit",       "--out",       out("alone")});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* const table : {"rows.csv", "pipelines.csv", "stability.csv", "stiffness.csv"}) {
    const std::string text = contents_of(out("alone/" + std::string(table)));
    EXPECT_THAT(text, HasSubstr("block_slabs"));
    EXPECT_THAT(text, testing::Not(HasSubstr("int_slabs"))) << table;
  }
}

TEST(HardwareAlone, IsPriced) {
  EXPECT_EQ(run_hitpipe({"area", "one_axis_slab"}).exit_code, 0);
}

class DesignWithoutSetUp : public testing::TestWithParam<std::vector<std::string>> {};

TEST_P(DesignWithoutSetUp, IsRefusedWhereRaysAreNeeded) {
  const Outcome run = run_hitpipe(GetParam());
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err,
            "hitpipe: design one_axis_slab: there is no set-up of rays and boxes for its operands\n");
}
INSTANTIATE_TEST_SUITE_P(
    Commands, DesignWithoutSetUp,
    testing::Values(std::vector<std::string>{"cosim", "one_axis_slab", "--scene", "waves"},
                    std::vector<std::string>{"check", "one_axis_slab"},
                    std::vector<std::string>{"check", "--stiff", "one_axis_slab"},
                    std::vector<std::string>{"sweep", "--scene", "waves", "one_axis_slab", "--out",
                                             "rows.csv"},
                    std::vector<std::string>{"fit", "--scene", "waves", "one_axis_slab", "--out", "fit"}),
    [](const auto& command) {
      return command.param.front() + (command.param[1] == "--stiff" ? "_stiff" : "");
    });

}  // namespace
}  // namespace hitpipe::cli
