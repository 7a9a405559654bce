// Rows of a sweep: their figures follow from their counts, and cells and files give them back.
#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/sweep/row.hpp"
#include "sim/sweep/rows_file.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/sweep/sample_rows.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::sim::rows_test {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(SweepRowFigures, AreThoseOfTheirDefinitions) {
  const SweepRow row = a_row();
  EXPECT_EQ(row.rays_traced(), 8000U);
  EXPECT_DOUBLE_EQ(row.occupancy_pct(), 80.0);
  EXPECT_DOUBLE_EQ(row.false_hits_per_million(), 307.5);
  EXPECT_DOUBLE_EQ(row.extra_box_tests_per_ray(), -0.1);
  EXPECT_DOUBLE_EQ(row.extra_triangle_tests_per_ray(), 0.125);
  EXPECT_DOUBLE_EQ(row.run_time_ms(), 1.588);  // 500,000 cycles of 3.176 ns
  EXPECT_DOUBLE_EQ(row.area_per_box_mm2(), 1.234567);
  EXPECT_DOUBLE_EQ(row.area_delay_mm2_ns(), 1.234567 * 3.176);
  EXPECT_DOUBLE_EQ(row.area_run_time_mm2_ms(), 1.234567 * 1.588);
  EXPECT_DOUBLE_EQ(row.extra_box_tests_pct(), -100.0 * 800 / 400'800);
  EXPECT_DOUBLE_EQ(row.extra_triangle_tests_pct(), 100.0 * 1000 / 69'000);
}

/// 70,000 triangle tests of 2.876 ns in a unit of 10 mm2; nodes of 23 bytes, triangles of 36.
TEST(SweepRowFigures, OfTheWholeCountTriangleTestsAndMemory) {
  const SweepRow row = a_row();
  constexpr double triangles_ms = 0.20132;
  EXPECT_DOUBLE_EQ(row.whole_run_time_ms(), 1.588 + triangles_ms);
  constexpr double set_up_ms = 0.96;  // 8,000 rays, three divisions, 20 bits of 2 ns
  ASSERT_TRUE(row.set_up_run_time_ms());
  EXPECT_DOUBLE_EQ(*row.set_up_run_time_ms(), set_up_ms);
  EXPECT_DOUBLE_EQ(row.whole_area_run_time_mm2_ms(),
                   1.234567 * 1.588 + (10 * triangles_ms * 1e6 + 1e5 * set_up_ms) / 1e6);
  ASSERT_TRUE(row.energy_nj_per_ray());
  EXPECT_DOUBLE_EQ(*row.energy_nj_per_ray(), 0.5 * 400'000 / 8000);
  EXPECT_EQ(row.nodes_fetched(), 400'000U);
  EXPECT_EQ(row.bytes_fetched(), 400'000U * 23 + 70'000U * 36);
  EXPECT_DOUBLE_EQ(row.bytes_per_ray(), 1465.0);
  EXPECT_DOUBLE_EQ(row.bytes_per_ray_4kib(), 500.0);
  EXPECT_DOUBLE_EQ(row.bytes_per_ray_64kib(), 125.0);
  EXPECT_DOUBLE_EQ(row.indexed_bytes_per_ray(), 1500.0);
  EXPECT_DOUBLE_EQ(row.indexed_bytes_per_ray_16kib(), 375.0);
  EXPECT_DOUBLE_EQ(row.reference_bytes_per_ray(), (400'800.0 * 32 + 69'000.0 * 36) / 8000);
  SweepRow free = row;
  free.triangle = {};
  free.set_up = {};
  EXPECT_FALSE(free.set_up_run_time_ms());
  EXPECT_DOUBLE_EQ(free.whole_run_time_ms(), free.run_time_ms());
  EXPECT_DOUBLE_EQ(free.whole_area_run_time_mm2_ms(), free.area_run_time_mm2_ms());
}

TEST(SweepRowFigures, OfAPairAreForEachBox) {
  const SweepRow row = a_pair();
  EXPECT_DOUBLE_EQ(row.occupancy_pct(), 80.0);
  EXPECT_DOUBLE_EQ(row.false_hits_per_million(), 307.5);
  EXPECT_DOUBLE_EQ(row.extra_box_tests_per_ray(), -0.1);
  EXPECT_DOUBLE_EQ(row.run_time_ms(), 1.588 / 2);
  EXPECT_DOUBLE_EQ(row.area_per_box_mm2(), 1.234567 / 2);
  EXPECT_DOUBLE_EQ(row.area_delay_mm2_ns(), 1.234567 / 2 * 3.176);
  EXPECT_EQ(row.nodes_fetched(), 400'000U) << "a record has two nodes";
  // The run time counts the whole unit, so the area is too.
  EXPECT_DOUBLE_EQ(row.area_run_time_mm2_ms(), 1.234567 * 1.588 / 2);
}

/// What is not known is an empty cell.
TEST(SweepRowCells, MayBeEmpty) {
  SweepRow row = a_row();
  row.set_up = {};
  row.energy_pj_per_box.reset();
  const std::vector<std::string> cells = to_cells(row);
  EXPECT_EQ(from_cells(cells), row);
  std::size_t empty = 0;
  for (const std::string& cell : cells) empty += cell.empty() ? 1 : 0;
  EXPECT_EQ(empty, 4U) << "divisions, the set-up's run time, energy a box and a ray";
}

/// A test every three cycles, in three times the cycles.
SweepRow a_third() {
  SweepRow row = a_row();
  row.interval = 3;
  row.cycles *= 3;
  return row;
}

TEST(SweepRowFigures, OfAnIntervalCountWhatTheUnitMayTake) {
  const SweepRow row = a_third();
  EXPECT_DOUBLE_EQ(row.occupancy_pct(), 80.0);
  EXPECT_DOUBLE_EQ(a_row().box_time_ns(), 3.176);
  EXPECT_DOUBLE_EQ(row.box_time_ns(), 3 * 3.176);
  EXPECT_DOUBLE_EQ(a_pair().box_time_ns(), 3.176 / 2);
  EXPECT_DOUBLE_EQ(row.area_delay_mm2_ns(), 1.234567 * 3 * 3.176);
  EXPECT_DOUBLE_EQ(row.run_time_ms(), 3 * 1.588);
}

TEST(RowsFile, HasTheIntervalOfEachRow) {
  const std::vector<SweepRow> rows{a_row(), a_third()};
  const std::string text = to_csv(rows);
  EXPECT_THAT(text, StartsWith(rows_header()));
  EXPECT_THAT(text, HasSubstr(",library,cost,rays_in_flight,ii,box_time_ns,design,"));
  EXPECT_THAT(text, HasSubstr(",32,1,3.176,int_slabs,n20/24,"));
  EXPECT_THAT(text, HasSubstr(",32,3,9.528,int_slabs,n20/24,"));
  EXPECT_EQ(parse_rows(text, "rows.csv"), rows);
  for (const int wrong : {0, 65}) {
    SweepRow bad = a_third();
    bad.interval = wrong;
    EXPECT_EQ(message_of<std::runtime_error>([&] { return from_cells(to_cells(bad)); }),
              fmt::format("{} of ii is not in 1 to 64", wrong));
  }
}

TEST(SweepRowFigures, OfNothingAreZero) {
  const SweepRow row;
  for (const double figure :
       {row.occupancy_pct(), row.false_hits_per_million(), row.extra_box_tests_per_ray(),
        row.extra_triangle_tests_per_ray(), row.extra_box_tests_pct(), row.extra_triangle_tests_pct(),
        row.run_time_ms(), row.bytes_per_ray(), row.reference_bytes_per_ray(), row.whole_run_time_ms(),
        row.whole_area_run_time_mm2_ms()})
    EXPECT_EQ(figure, 0.0);
}

TEST(SweepRowFigures, NothingThatMustBeZeroIsForgiven) {
  EXPECT_TRUE(a_row().verified(true));
  for (const auto count :
       {&SweepRow::rtl_mismatches, &SweepRow::different_triangles, &SweepRow::different_pixels}) {
    SweepRow row = a_row();
    row.*count = 1;
    EXPECT_FALSE(row.verified(true));
    EXPECT_FALSE(row.verified(false));
  }
  SweepRow row = a_row();
  row.false_misses = 1;
  EXPECT_FALSE(row.verified(true));
  EXPECT_TRUE(row.verified(false));
}

TEST(SweepRowCells, GiveTheRowBack) {
  const std::vector<std::string> cells = to_cells(a_row());
  ASSERT_EQ(cells.size(), sweep_columns.size());
  const auto cell = [&](std::string_view column) { return sweep_column(column).cell(a_row()); };
  EXPECT_EQ(cell("library"), "thesis_250nm");
  EXPECT_EQ(cell("boxes_per_test"), "1");
  EXPECT_EQ(cell("stage_delay_ns"), "3.176");
  EXPECT_EQ(cell("area_mm2"), "1.234567");
  EXPECT_EQ(cell("bytes_per_node"), "23");
  EXPECT_EQ(cell("triangle_delay_ns"), "2.876");
  EXPECT_EQ(cell("triangle_area_mm2"), "10.000000");
  EXPECT_EQ(cell("bytes_fetched"), "11720000");
  EXPECT_EQ(cell("scene"), "two, \"quoted\"");
  EXPECT_EQ(from_cells(cells), a_row());
  EXPECT_EQ(from_cells(to_cells(a_pair())), a_pair());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (sweep_columns[i].is_text()) continue;
    EXPECT_EQ(sweep_columns[i].number(a_row()), std::stod(cells[i])) << sweep_columns[i].name;
  }
  EXPECT_THROW((void)sweep_column("area"), std::out_of_range);
  EXPECT_THROW((void)sweep_column("scene").number(a_row()), std::invalid_argument);
}

TEST(SweepRowCells, NumbersThatDoNotBelongRejected) {
  for (std::size_t column = 0; column < sweep_columns.size(); ++column) {
    if (sweep_columns[column].is_text()) continue;
    for (const char* const wrong : {"", "x", "1x", "1e", "12345.5", "0x1"}) {
      std::vector<std::string> cells = to_cells(a_row());
      cells[column] = wrong;
      const bool time = column + sweep_time_columns >= sweep_columns.size();
      const std::string_view name = sweep_columns[column].name;
      const bool may_be_unknown =
          name == "set_up_divisions" || name == "energy_pj_per_box" || name.starts_with("software_s");
      if (may_be_unknown && std::string(wrong).empty()) continue;
      if ((time || name == "energy_pj_per_box" || name.ends_with("_high")) && std::string(wrong) == "12345.5")
        continue;
      EXPECT_THAT(message_of<std::runtime_error>([&] { return from_cells(cells); }),
                  HasSubstr(sweep_columns[column].name))
          << sweep_columns[column].name << " = " << wrong;
    }
  }
  EXPECT_EQ(message_of<std::runtime_error>([] { return from_cells({"spheres"}); }), "1 cells; a row has 97");
}

TEST(SweepRowCells, FiguresThatDoNotFollowRejected) {
  std::vector<std::string> cells = to_cells(a_row());
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (sweep_columns[i].name == "unit_tests" || sweep_columns[i].name == "box_tests") cells[i] = "400001";
  EXPECT_THAT(message_of<std::runtime_error>([&] { return from_cells(cells); }),
              StartsWith("80 of occupancy_pct does not follow from the counts, which give 80.0002"));
}

TEST(SweepRowCells, BoxesThatTheTestsCannotAnswerForRejected) {
  const auto refused = [](std::uint64_t unit_tests, std::uint64_t box_tests, int boxes_per_test) {
    SweepRow row = a_row();
    row.extra_box_pct_low = row.extra_box_pct_high = std::nullopt;
    row.unit_tests = unit_tests;
    row.box_tests = box_tests;
    row.boxes_per_test = boxes_per_test;
    return message_of<std::runtime_error>([&] { return from_cells(to_cells(row)); });
  };
  EXPECT_EQ(refused(3, 6, 2), "no exception");
  EXPECT_EQ(refused(3, 3, 2), "no exception");
  EXPECT_EQ(refused(3, 7, 2), "7 of box_tests cannot be answered by 3 tests of 2 boxes");
  EXPECT_EQ(refused(3, 2, 2), "2 of box_tests cannot be answered by 3 tests of 2 boxes");
  EXPECT_EQ(refused(3, 4, 1), "4 of box_tests cannot be answered by 3 tests of 1 boxes");
  EXPECT_EQ(refused(3, 3, 0), "0 of boxes_per_test is less than 1");
}

TEST(RowsFile, IsReadAsWritten) {
  const TemporaryFolder folder;
  const std::vector<SweepRow> rows{a_row(), a_row()};
  write_rows(folder.path() / "rows.csv", rows);
  EXPECT_EQ(read_rows(folder.path() / "rows.csv"), rows);
  const std::string text = to_csv(rows);
  EXPECT_THAT(text, StartsWith("program,scene,content,triangles,hierarchy,bvh_nodes,width,height,bounces,"
                               "diffuse,occlusion,light_seed,"));
  EXPECT_THAT(text, HasSubstr(",software_s_per_mray_low,software_s_per_mray_high\nhitpipe 1,\"two, "
                              "\"\"quoted\"\"\",fnv1a-0123,24578,"));
}

/// Any part may be cut off. A file with whole lines is a sweep that is not finished; any other file is
/// refused.
TEST(RowsFile, CutShortRejected) {
  const std::string text = to_csv(std::vector{a_row(), a_row()});
  std::size_t refused = 0;
  for (std::size_t length = 0; length < text.size(); ++length) {
    const std::string cut = text.substr(0, length);
    const std::string message = message_of<std::runtime_error>([&] { return parse_rows(cut, "rows.csv"); });
    EXPECT_EQ(message == "no exception", cut.ends_with('\n')) << length << ": " << message;
    refused += message == "no exception" ? 0 : 1;
  }
  fmt::print("{} of {} cuts refused\n", refused, text.size());
  EXPECT_EQ(message_of<std::runtime_error>([] { return read_rows("/nonexistent/rows.csv"); }),
            "/nonexistent/rows.csv: cannot read the rows");
}

/// Files of earlier versions began with a comment.
TEST(RowsFile, OfAnotherVersionIsRefused) {
  EXPECT_EQ(message_of<std::runtime_error>([] { return parse_rows("# a sweep\nscene\n", "rows.csv"); }),
            "rows.csv: line 1 is not the header of a sweep by this version, so its rows must be measured "
            "again; give another file or remove it");
}

TEST(RowsFile, HasRowsOfOneSubject) {
  for (const auto& change : std::vector<void (*)(SweepRow&)>{
           [](SweepRow& row) { row.program = "hitpipe 2"; }, [](SweepRow& row) { row.content = "fnv1a-0"; },
           [](SweepRow& row) { row.hierarchy = "median 6"; }, [](SweepRow& row) { row.bounces = 4; },
           [](SweepRow& row) { row.diffuse = 1; }, [](SweepRow& row) { row.occlusion = 1; },
           [](SweepRow& row) { row.light_seed = 1; }}) {
    SweepRow other = a_row();
    change(other);
    EXPECT_THAT(message_of<std::runtime_error>([&] {
                  return parse_rows(to_csv(std::vector{a_row(), other}), "rows.csv");
                }),
                StartsWith("rows.csv: line 3 has a row of \"" + other.text() + "\", line 2 of \""));
  }
}

}  // namespace
}  // namespace hitpipe::sim::rows_test
