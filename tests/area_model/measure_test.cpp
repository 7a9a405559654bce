// osu018.json is what area_model/measure/measure measures, and prices every design.
#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "area_model/price.hpp"
#include "host/process.hpp"
#include "host/scratch_folder.hpp"
#include "tests/rtl_gen/tool.hpp"

namespace hitpipe::area {
namespace {

const std::string measure = HITPIPE_SOURCE "/area_model/measure/measure";
const std::string osu018 = HITPIPE_SOURCE "/rtl_gen/component/libraries/osu018.json";

/// Measures two small components and compares them with a file.
host::Outcome check(const std::string& library) {
  return host::run({measure, "--check", "--library", library, "mux2:8", "int_compare:8"});
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
  const host::Outcome same = check(osu018);
  EXPECT_EQ(same.exit_code, 0) << same.out << same.err;
  EXPECT_EQ(same.out, "2 cells measured, 0 differences\n");
}

TEST_F(Measured, AnotherFigureInTheFileIsADifference) {
  nlohmann::json library = nlohmann::json::parse(rtl::read_text(osu018));
  for (auto& row : library["components"]["int_compare"]["cells"]) {
    if (row["bits"] == 8) row["delay_ps"] = row["delay_ps"].get<int>() + 1;
  }
  const host::ScratchFolder folder;
  rtl::write_text(folder / "other.json", library.dump());
  const host::Outcome other = check(folder / "other.json");
  EXPECT_EQ(other.exit_code, 1);
  EXPECT_EQ(other.out.rfind("int_compare_8: measured ", 0), 0) << other.out;
}

TEST(MeasureScript, RefusesAWidthThatTheFileDoesNotHave) {
  const host::Outcome refused = host::run({measure, "--check", "mux2:7"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_EQ(refused.err.rfind("measure: mux2:7: allowed are latch, ", 0), 0) << refused.err;
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
}  // namespace hitpipe::area
