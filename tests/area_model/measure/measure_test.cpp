// osu018.json is what area_model/measure/measure.py measures, and prices every design.
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "area_model/price.hpp"
#include "host/files.hpp"
#include "host/process.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::area::measure_test {
namespace {

const std::string scripts = HITPIPE_SOURCE "/area_model/measure/";
const std::string osu018 = HITPIPE_SOURCE "/rtl_gen/component/libraries/osu018.json";

/// Measures small components again and compares them with a file.
host::Outcome check(const std::string& library, const std::vector<std::string>& components) {
  std::vector<std::string> words{
      scripts + "measure.py", "--hitpipe", HITPIPE_PROGRAM, "--check", "--library", library};
  words.insert(words.end(), components.begin(), components.end());
  return host::run(words);
}

class Measured : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* tool : {"sta", "yosys", "berkeley-abc"}) {
      if (host::run({tool, tool == std::string("sta") ? "-version" : "-h"}).not_found())
        GTEST_SKIP() << tool << " was not found: the cells are not measured again";
    }
    if (!std::filesystem::exists("/usr/share/qflow/tech/osu018/osu018_stdcells.lib"))
      GTEST_SKIP() << "qflow-tech-osu018 is not installed: the cells are not measured again";
  }
};

TEST_F(Measured, CellsAreThoseOfTheFile) {
  const host::Outcome same = check(osu018, {"mux2:8", "int_compare:8"});
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_EQ(same.out, "2 cells measured, 0 differences\n");
}

TEST_F(Measured, AnotherFigureInTheFileIsADifference) {
  nlohmann::json library = nlohmann::json::parse(rtl::read_text(osu018));
  for (auto& row : library["components"]["int_compare"]["cells"])
    if (row["bits"] == 8) row["delay_ps"] = row["delay_ps"].get<int>() + 1;
  const host::ScratchFolder scratch;
  rtl::write_text(scratch / "other.json", library.dump());
  const host::Outcome other = check(scratch / "other.json", {"int_compare:8"});
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_EQ(other.out.rfind("int_compare_8: measured ", 0), 0) << other.out;
}

TEST(MeasureScript, RefusesAWidthThatTheFileDoesNotHave) {
  const host::Outcome refused = host::run({scripts + "measure.py", "--check", "mux2:7"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err.rfind("measure: mux2:7: allowed are latch, ", 0), 0) << refused.err;
}

// The units themselves take an hour; the model's side of the tables takes a second.
TEST(MeasuredUnits, TablesOfTheDocsAreThoseThatTheScriptPrints) {
  const host::Outcome printed = host::run({scripts + "compare.py", "--hitpipe", HITPIPE_PROGRAM});
  ASSERT_EQ(printed.exit_code, 0) << printed.err;
  const std::string docs = rtl::read_text(HITPIPE_SOURCE "/docs/chips.md") +
                           rtl::read_text(HITPIPE_SOURCE "/docs/measured/chips.md") +
                           rtl::read_text(HITPIPE_SOURCE "/docs/never_misses.md");
  std::istringstream lines(printed.out);
  int rows = 0;
  for (std::string line; std::getline(lines, line);) {
    if (line.empty()) continue;
    EXPECT_NE(docs.find(line + '\n'), std::string::npos) << line;
    ++rows;
  }
  EXPECT_GT(rows, 20);
}

TEST(MeasuredUnits, OfEveryDesignAreCompared) {
  const host::Outcome planned = host::run({scripts + "compare.py", "--hitpipe", HITPIPE_PROGRAM, "--plan"});
  ASSERT_EQ(planned.exit_code, 0) << planned.err;
  for (const rtl::Design& design : rtl::designs()) {
    const std::string unit =
        fmt::format("osu018 timed {} {} ", design.name, to_string(design.default_format));
    EXPECT_NE(planned.out.find(unit), std::string::npos) << unit;
  }
  EXPECT_NE(planned.out.find("thesis_250nm timed int_plucker 20/24 measured\n"), std::string::npos);
}

TEST(MeasuredLibrary, PricesEveryDesignAtTheClockItWasMeasuredFor) {
  const rtl::Library library = rtl::Library::load(osu018);
  for (const rtl::Design& design : rtl::designs()) {
    const Price priced = price(design, design.default_format, library, Account::built);
    EXPECT_GT(priced.area_um2, 100'000) << design.name;
    EXPECT_LE(priced.stage_delay_ps, 4000) << design.name;
    EXPECT_GT(priced.stage_delay_ps, 3000) << design.name;
  }
}

}  // namespace
}  // namespace hitpipe::area::measure_test
