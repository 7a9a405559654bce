// A result that went through a file is the same to its last bit.
#include "thesis/result_file.hpp"

#include <limits>

#include <gtest/gtest.h>

#include "thesis/experiment.hpp"
#include "thesis/reproduction_page.hpp"

namespace hitpipe::thesis::result_file_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

ResultTable again(const ResultTable& table) {
  return parse_result(Row::parse(kept_result(table).dump()));
}

ResultTable awkward() {
  return {.number = "9.9",
          .title = "A \"title\", with ä",
          .labels = {"scene", "bits"},
          .columns = {{"one", 2, 0.005}, {"two", 0, 0}},
          .rows = {{.labels = {"a", "8"},
                    .ours = {1.0 / 3.0, std::nullopt},
                    .printed = {std::nullopt, -0.1},
                    .intervals = {Interval{-infinity, infinity}, std::nullopt},
                    .unit = 1},
                   {.labels = {"b", "9"}, .ours = {infinity, 5e-324}, .printed = {1e300, 0.0}}},
          .findings = {{.claim = "more",
                        .figures = {{"x", 1, 2, 0.5, Interval{1, 2.5}}, {"y", 0, 1}},
                        .why = "so"}},
          .notes = {"a note"}};
}

TEST(ResultFile, KeepsEverything) {
  const ResultTable table = awkward();
  const ResultTable read = again(table);
  EXPECT_EQ(kept_result(read), kept_result(table));
  EXPECT_EQ(read.rows[0].ours, table.rows[0].ours);
  EXPECT_EQ(read.rows[0].printed, table.rows[0].printed);
  EXPECT_EQ(read.rows[0].intervals[0]->low, -infinity);
  EXPECT_FALSE(read.rows[0].intervals[1]);
  EXPECT_EQ(read.rows[0].unit, 1U);
  EXPECT_EQ(read.rows[1].ours, table.rows[1].ours);
  EXPECT_TRUE(read.rows[1].intervals.empty());
  EXPECT_EQ(read.findings[0].figures[0].interval->high, 2.5);
  EXPECT_FALSE(read.findings[0].figures[1].interval);
  EXPECT_EQ(read.columns[0].half_unit, 0.005);
}

TEST(ResultFile, ThePageOfReadTablesIsThePageOfTheTables) {
  for (const char* const number : {"4.2", "7.1", "7.2"}) {
    const ResultTable table = find_experiment(number).run(number, {});
    const ResultTable read = again(table);
    EXPECT_EQ(reproduction_page({read}, "command"), reproduction_page({table}, "command")) << number;
    EXPECT_EQ(reproduction_rows({read}), reproduction_rows({table})) << number;
    EXPECT_EQ(result_text(read), result_text(table)) << number;
  }
}

TEST(ResultFile, OtherFormsRejected) {
  Row row = kept_result(awkward());
  row["rows"][0]["ours"][0] = true;
  EXPECT_THROW((void)parse_result(row), Row::exception);
  row = kept_result(awkward());
  row.erase("findings");
  EXPECT_THROW((void)parse_result(row), Row::exception);
}

}  // namespace
}  // namespace hitpipe::thesis::result_file_test
