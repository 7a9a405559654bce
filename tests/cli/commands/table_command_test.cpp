// `hitpipe table`: our figures and the thesis's in the same rows, and the page that judges them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/cli/program.hpp"

namespace hitpipe::cli::table_command_test {
namespace {

using testing::HasSubstr;

/// A run of less than a second: one scene, few rays.
std::vector<std::string> quick(const std::string& number, const std::vector<std::string>& more = {}) {
  return with({"table", number, "--only", "Spheres", "--width", "16", "--height", "12", "--repeats", "1"},
              more);
}

TEST(TableCommand, PrintsTheThesisFiguresBelowOurs) {
  const Outcome outcome = run_hitpipe(quick("5.1"));
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, testing::StartsWith("Table 5.1: "));
  EXPECT_THAT(outcome.out, HasSubstr("\nSpheres\n"));
  EXPECT_THAT(outcome.out, HasSubstr("  bvh_memory                ours    387808  96952  145428\n"));
  EXPECT_THAT(outcome.out, HasSubstr("thesis  362848  90712  136068\n"));
  EXPECT_THAT(outcome.out, HasSubstr("8 bits cost 0 to 4 % more tests: "));
}

TEST(TableCommand, FitsEightyColumns) {
  for (const char* const number : {"4.1", "5.3", "6.2"}) {
    const auto lines = lines_of(run_hitpipe(quick(number)).out);
    for (const std::string& line : lines) EXPECT_LE(line.size(), 80U) << number << ": " << line;
  }
}

TEST(TableCommand, PutsTheWordsOfWideHeadingsInLines) {
  const Outcome outcome = run_hitpipe({"table", "7.2"});
  EXPECT_EQ(outcome.exit_code, 0);
  for (const std::string& line : lines_of(outcome.out)) EXPECT_LE(line.size(), 80U) << line;
  EXPECT_THAT(outcome.out, HasSubstr("  pipe  delay  clock  latency     mm2\nunit  "));
}

TEST(TableCommand, JsonHasBothSourcesFindingsAndNotes) {
  const auto table = nlohmann::json::parse(run_hitpipe(quick("6.2", {"--format", "json"})).out);
  EXPECT_EQ(table.at("number"), "6.2");
  const auto& row = table.at("rows").at(0);
  EXPECT_EQ(row.at("scene"), "Spheres");
  EXPECT_EQ(row.at("thesis").at("fp32"), 5.29);
  EXPECT_EQ(row.at("thesis").at("16/16"), 5.0);
  EXPECT_GT(row.at("ours").at("fp32"), 1.0);
  EXPECT_EQ(table.at("findings").back().at("verdict"), "agrees") << "answers differ";
  EXPECT_TRUE(row.at("interval_95").at("16/16").is_null()) << "one tile has no spread";
  EXPECT_FALSE(table.at("notes").empty());
}

TEST(TableCommand, IntervalIsBesideTheFigureInEveryFormat) {
  const auto two_tiles = [](const std::string& format) {
    return run_hitpipe(
               {"table", "6.2", "--only", "Spheres", "--width", "48", "--height", "12", "--format", format})
        .out;
  };
  const auto row = nlohmann::json::parse(two_tiles("json")).at("rows").at(3);
  EXPECT_LE(row.at("interval_95").at("16/16").at(0), row.at("ours").at("16/16"));
  EXPECT_GE(row.at("interval_95").at("16/16").at(1), row.at("ours").at("16/16"));
  EXPECT_THAT(two_tiles("csv"), HasSubstr("\nSpheres,node,pri,ours_low,,"));
  EXPECT_THAT(two_tiles("text"), HasSubstr("\n              +-95 % "));
}

TEST(TableCommand, CsvHasALineForEachSource) {
  const auto lines = lines_of(run_hitpipe(quick("4.3", {"--format", "csv"})).out);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[0], "scene,metric,source,Plu,Plu-DSA");
  EXPECT_TRUE(lines[1].starts_with("Spheres,time,ours,1.0,"));
  EXPECT_TRUE(lines[2].starts_with("Spheres,time,thesis,1.0,0.869"));
}

TEST(TableCommand, ChapterSevenAndTheOrderOfChildrenAreThere) {
  EXPECT_THAT(run_hitpipe({"table", "7.1"}).out, HasSubstr("agrees: the library has the circuits"));
  EXPECT_THAT(run_hitpipe({"table", "7.2"}).out, HasSubstr("fp_slabs fp32"));
  EXPECT_THAT(run_hitpipe({"table", "4.2"}).out, HasSubstr("thesis 24, ours 24"));
}

TEST(TableJudge, WritesThePageAndEveryFigure) {
  const sim::TemporaryFolder folder;
  const std::string out = (folder.path() / "page.md").string();
  const std::string words =
      "hitpipe table 4.2 6.2 7.1 7.2 --judge --scene Branch=spheres --scene Bunny=spheres "
      "--width 16 --height 12 --repeats 1 --out " +
      out;
  EXPECT_EQ(printed(words.substr(8)), "");
  const std::string page = contents_of(out);
  EXPECT_THAT(page, HasSubstr(words));
  EXPECT_THAT(page,
              HasSubstr("| 4.2 | a ray visits first the child on the side that it comes from | orders that "
                        "are equal | 24 | 24 | agrees |"));
  EXPECT_THAT(page, HasSubstr("| 7.1 | area_mm2 | 19 | 19 | 0 | 0 | 1.00 |"));
  const auto rows = lines_of(contents_of(folder.path() / "page.csv"));
  EXPECT_EQ(rows[0], "table,row,column,thesis,ours,ours_low,ours_high,ratio,verdict");
  EXPECT_EQ(rows[1], "4.2,MMM x,first_child,1.0,1.0,,,1.0,agrees");
  // 24 orders, 16 rows of 10 figures, 19 circuits of 3, 6 units of 6.
  EXPECT_EQ(rows.size(), 1U + 24U + 160U + 57U + 36U);
}

/// What does not depend on the machine is the same in the page that is kept: the tables that take no time.
TEST(TableJudge, KeptPageHasTodaysFigures) {
  const auto kept = lines_of(contents_of(HITPIPE_SOURCE "/docs/measured/reproduction.md"));
  int compared = 0;
  for (const std::string& line : lines_of(printed("table --judge 4.2,7.1,7.2"))) {
    if (!line.starts_with("| 4.2 |") && !line.starts_with("| 7.")) continue;
    EXPECT_THAT(kept, testing::Contains(line));
    ++compared;
  }
  EXPECT_GT(compared, 15);
}

TEST(TableCommand, TablesAndScenesThatThereAreNotRejected) {
  const std::pair<const char*, const char*> cases[] = {
      {"table 4.5", "4.5: no experiment of that number; there are 3.1, 3.2, 4.1, 4.2,"},
      {"table --judge 4.5", "4.5: no experiment of that number; there are 3.1,"},
      {"table 4.1 --only Teapot", "table 4.1 has no scene \"Teapot\"; it has: Spheres, Bunny,"},
      {"table 5.3 --only Bunny --scene Bunny=none.ply", "mesh file \"none.ply\": no such file"}};
  for (const auto& [words, message] : cases) {
    const Outcome outcome = hitpipe(words);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_THAT(outcome.err, testing::StartsWith("hitpipe: " + std::string(message)));
    EXPECT_EQ(lines_of(outcome.err).size(), 1U);
  }
}

}  // namespace
}  // namespace hitpipe::cli::table_command_test
