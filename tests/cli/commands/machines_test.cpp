// `rtl`, `area` and `list` with a machine in place of a design.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::cli::machines_test {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

class Machines : public testing::Test {
 protected:
  Outcome written() {
    return run_hitpipe({"rtl", "divider", "--bits", "12+1s12i3", "--vectors", "300", "--name", "unit",
                        "--out", out_.string()});
  }
  rtl::ToolResult simulated(const std::string& target) const {
    return rtl::run_tool(out_, "make", "make",
                         "-s -C tb " + target +
                             " OPT_FAST=-O0 OPT_SLOW=-O0 OPT_GLOBAL=-O0 OBJCACHE='sh " HITPIPE_SOURCE
                             "/tests/rtl_gen/emit/kept_object.sh'");
  }

  sim::TemporaryFolder folder_;
  const std::filesystem::path out_ = folder_.path() / "out";
};

TEST_F(Machines, WritesFilesThatPassInBothSimulators) {
  const Outcome outcome = written();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("clock_ps"));
  EXPECT_THAT(files_below(out_), IsSupersetOf({"tb/Makefile", "tb/unit_tb.sv", "tb/unit_vectors.hex",
                                               "unit.dot", "unit.json", "unit.v"}));
  for (const char* target : {"icarus", "verilator"}) {
    const rtl::ToolResult result = simulated(target);
    EXPECT_EQ(result.status, 0) << result.output;
    EXPECT_THAT(result.output, HasSubstr("PASS 300 cycles"));
  }
}

TEST_F(Machines, TheTestbenchSeesAChange) {
  ASSERT_EQ(written().exit_code, 0);
  rtl::damage(out_ / "unit.v", "answers <= compares", "answers <= last");
  const rtl::ToolResult changed = simulated("icarus");
  EXPECT_NE(changed.status, 0);
  EXPECT_THAT(changed.output, HasSubstr("answers is 1, expected 0"));
}

TEST_F(Machines, TheTestbenchSeesAMissingLine) {
  ASSERT_EQ(written().exit_code, 0);
  std::string lines = rtl::read_text(out_ / "tb/unit_vectors.hex");
  lines.resize(lines.size() / 2);
  rtl::write_text(out_ / "tb/unit_vectors.hex", lines.substr(0, lines.rfind('\n') + 1));
  const rtl::ToolResult cut = simulated("icarus");
  EXPECT_NE(cut.status, 0);
  EXPECT_THAT(cut.output, HasSubstr("unit_vectors.hex has no line for it"));
}

TEST_F(Machines, HaveAPrice) {
  const Outcome cells = run_hitpipe({"area", "divider", "--format", "csv"});
  EXPECT_THAT(cells.out, HasSubstr("machine,bits,library,clock_ps,register_bits,memory_bits,area_mm2\n"));
  EXPECT_THAT(cells.out, HasSubstr("divider,20+1s20i5,thesis_250nm,"));
  const Outcome chip = run_hitpipe({"area", "divider", "--library", "xc7", "--format", "csv"});
  EXPECT_THAT(chip.out, HasSubstr("memory_bits,lut,ff\n"));
}

TEST_F(Machines, AreListed) {
  EXPECT_THAT(run_hitpipe({"list", "machines"}).out,
              testing::ContainsRegex("divider +20[+]1s20i5 +distance"));
  EXPECT_THAT(run_hitpipe({"list", "machines", "--format", "json"}).out, HasSubstr("I in 1..8"));
}

TEST_F(Machines, RefuseWhatIsForDesigns) {
  const auto refused = [&](std::vector<std::string> words) {
    const Outcome outcome = run_hitpipe(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_EQ(outcome.out, "");
    return outcome.err;
  };
  EXPECT_THAT(refused({"rtl", "divider", "--fifo", "--out", out_.string()}),
              HasSubstr("--fifo: divider is a machine"));
  EXPECT_THAT(refused({"rtl", "divider", "--bits", "20+1s20", "--out", out_.string()}), HasSubstr("n+gsSiI"));
  EXPECT_THAT(refused({"area", "divider", "int_slabs"}), HasSubstr("allowed are machines alone"));
  EXPECT_THAT(refused({"area", "divider", "--ii", "2"}), HasSubstr("--ii: divider is a machine"));
  EXPECT_THAT(refused({"area", "divider", "--bits", "20+1s20i5,16+1s16i5"}), HasSubstr("one with machines"));
  EXPECT_THAT(refused({"core", "rtl", "--ii", "2", "--out", out_.string()}),
              HasSubstr("--ii: no such option"));
  EXPECT_THAT(refused({"core", "rtl", "--bits", "20+1s20", "--out", out_.string()}),
              HasSubstr("n+g/pfBsStF"));
  EXPECT_FALSE(std::filesystem::exists(out_));
}

TEST_F(Machines, TogetherAreACore) {
  const Outcome outcome = run_hitpipe({"core", "rtl", "--bits", "12+1/7s12", "--rays", "8", "--cycles", "100",
                                       "--out", out_.string(), "--format", "json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto said = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(said.at("rays"), 8);
  EXPECT_EQ(said.at("cycles"), 100);
  // The folder has these files, and no others.
  std::size_t there = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(out_))
    there += entry.is_regular_file() ? 1 : 0;
  EXPECT_EQ(said.at("files").size(), there);
  EXPECT_GT(there, 10U);
  for (const std::string file : said.at("files")) EXPECT_TRUE(std::filesystem::exists(file)) << file;
}

}  // namespace
}  // namespace hitpipe::cli::machines_test
