// Rows as text, CSV and JSON.
#include "cli/text/table.hpp"

#include <gtest/gtest.h>

namespace hitpipe::cli::table_test {
namespace {

TEST(Record, IsOneLineAValueAsText) {
  const Row row{{"name", "spheres"}, {"count", 1234567},       {"small", 999},    {"thousand", 1000},
                {"debt", -1234},     {"small_debt", -123},     {"share", 99.987}, {"rate", 8365096.4},
                {"none", nullptr},   {"files", {"a.v", "b.v"}}};
  EXPECT_EQ(record_text(row, OutputFormat::text),
            "name        spheres\n"
            "count       1,234,567\n"
            "small       999\n"
            "thousand    1,000\n"
            "debt        -1,234\n"
            "small_debt  -123\n"
            "share       99.99\n"
            "rate        8,365,096\n"
            "none        not judged\n"
            "files       a.v\n"
            "            b.v\n");
}

TEST(Record, IsAHeaderAndALineAsCsv) {
  const Row row{
      {"name", "a, \"b\""}, {"count", 1234567}, {"share", 0.5}, {"none", nullptr}, {"files", {"a.v", "b c"}}};
  EXPECT_EQ(record_text(row, OutputFormat::csv),
            "name,count,share,none,files\n"
            "\"a, \"\"b\"\"\",1234567,0.5,,a.v b c\n");
}

TEST(Record, EmptyFirstCellKeepsItsColumnAsCsv) {
  EXPECT_EQ(record_text({{"name", ""}, {"count", 1}}, OutputFormat::csv), "name,count\n,1\n");
  EXPECT_EQ(record_text({{"none", nullptr}, {"count", 1}}, OutputFormat::csv), "none,count\n,1\n");
}

TEST(Record, ListsAreWordsAsCsv) {
  EXPECT_EQ(record_text({{"words", {"a", "b"}}, {"numbers", {0, 2, 1}}}, OutputFormat::csv),
            "words,numbers\na b,0 2 1\n");
}

TEST(Record, LineBreaksAreQuotedAsCsv) {
  EXPECT_EQ(record_text({{"a", "x\ry"}, {"b", "x\ny"}}, OutputFormat::csv), "a,b\n\"x\ry\",\"x\ny\"\n");
}

TEST(Record, NameThatIsNoUtf8IsPrinted) {
  const Row row{{"name", "\xff.obj"}, {"count", 1}};
  EXPECT_EQ(record_text(row, OutputFormat::json),
            "{\n  \"name\": \"\xEF\xBF\xBD.obj\",\n  \"count\": 1\n}\n");
  EXPECT_EQ(record_text(row, OutputFormat::csv), "name,count\n\xff.obj,1\n");
}

TEST(Record, IsAnObjectInTheSameOrderAsJson) {
  const Row row{{"z", "x"}, {"a", 1}};
  EXPECT_EQ(record_text(row, OutputFormat::json), "{\n  \"z\": \"x\",\n  \"a\": 1\n}\n");
}

TEST(Table, AlignsWordsLeftAndNumbersRight) {
  const std::vector<Row> rows{{{"design", "a"}, {"stages", 5}, {"what", "first"}},
                              {{"design", "longer"}, {"stages", 12345}, {"what", "second one"}}};
  EXPECT_EQ(table_text(rows, OutputFormat::text),
            "design  stages  what\n"
            "a            5  first\n"
            "longer  12,345  second one\n");
}

TEST(Table, IsALineARowAsCsvAndAnArrayAsJson) {
  const std::vector<Row> rows{{{"design", "a"}, {"stages", 5}}, {{"design", "b"}, {"stages", 4}}};
  EXPECT_EQ(table_text(rows, OutputFormat::csv), "design,stages\na,5\nb,4\n");
  EXPECT_EQ(Row::parse(table_text(rows, OutputFormat::json)), Row(rows));
}

TEST(Columns, AreRowsUnderTheirFirstValue) {
  const std::vector<Row> rows{
      {{"module", "core"},
       {"luts", 12345},
       {"fmax_mhz", nullptr},
       {"share_of", "luts"},
       {"path_ns", nullptr}},
      {{"module", "core_axi"}, {"luts", 8}, {"fmax_mhz", nullptr}, {"share_of", "dsps"}, {"path_ns", 5.5}}};
  EXPECT_EQ(columns_text(rows),
            "                core  core_axi\n"
            "luts          12,345         8\n"
            "share_of        luts      dsps\n"
            "path_ns   not judged      5.50\n");
}

TEST(Table, WithoutRowsIsEmpty) {
  EXPECT_EQ(table_text({}, OutputFormat::text), "");
  EXPECT_EQ(table_text({}, OutputFormat::csv), "");
  EXPECT_EQ(table_text({}, OutputFormat::json), "[]\n");
}

}  // namespace
}  // namespace hitpipe::cli::table_test
