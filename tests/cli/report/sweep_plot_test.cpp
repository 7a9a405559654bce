// Work-precision diagrams: which units are on the front, where marks are, and that axes are the same for all
// scenes.
#include "cli/report/sweep_plot.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/sweep_rows.hpp"

namespace hitpipe::cli {
namespace {

using testing::HasSubstr;
using testing::Not;

bool operator==(const CostAndError& a, const CostAndError& b) {
  return a.cost == b.cost && a.error == b.error;
}

sim::SweepRow row(const std::string& design, const std::string& bits, std::uint64_t box_tests) {
  sim::SweepRow made;
  made.scene = "spheres";
  made.design = design;
  made.bits = bits;
  made.rays_in_flight = 32;
  made.stage_delay_ps = 3000;
  made.area_um2 = 2'000'000;
  made.unit_tests = box_tests;
  made.box_tests = box_tests;
  made.reference_box_tests = 1000;
  made.cycles = 2 * box_tests;
  return made;
}

/// The same boxes by a unit that answers for two in a test.
sim::SweepRow pair_row(std::uint64_t box_tests) {
  sim::SweepRow made = row("int_major_pair", "20+1/12", box_tests);
  made.boxes_per_test = 2;
  made.unit_tests = box_tests / 2;
  made.cycles = box_tests;
  return made;
}

TEST(ParetoFront, HasWhatNoneBetters) {
  const std::vector<CostAndError> front =
      pareto_front({{3, 1}, {1, 5}, {2, 5}, {2, 3}, {4, 1}, {5, 0.5}, {1, 6}});
  ASSERT_EQ(front.size(), 4U);
  EXPECT_TRUE(front[0] == (CostAndError{1, 5}));
  EXPECT_TRUE(front[1] == (CostAndError{2, 3}));
  EXPECT_TRUE(front[2] == (CostAndError{3, 1}));
  EXPECT_TRUE(front[3] == (CostAndError{5, 0.5}));
  EXPECT_TRUE(pareto_front({}).empty());
}

TEST(SweepRows, FiguresFollowFromTheCounts) {
  const sim::SweepRow unit = row("int_slabs", "20/24", 1500);
  EXPECT_DOUBLE_EQ(extra_box_tests_pct(unit), 50);
  EXPECT_DOUBLE_EQ(run_time_ns(unit), 9);  // 3000 cycles of 3 ns for 1000 box tests
  EXPECT_DOUBLE_EQ(extra_box_tests_pct(row("fp_slabs", "fp32", 990)), -1);
  EXPECT_EQ(cell(unit, "area_mm2"), "2.000000");
}

/// A pair needs half the cycles. So its area is halved once: in the area for each box, and not again in area
/// times run time.
TEST(SweepRows, APairCountsTwoBoxes) {
  const sim::SweepRow unit = pair_row(1500);
  EXPECT_DOUBLE_EQ(extra_box_tests_pct(unit), 50);
  EXPECT_DOUBLE_EQ(run_time_ns(unit), 4.5);
  EXPECT_DOUBLE_EQ(unit.occupancy_pct(), 50);
  EXPECT_EQ(cell(unit, "area_mm2"), "2.000000");
  EXPECT_EQ(cell(unit, "area_per_box_mm2"), "1");
  const std::vector rows{unit};
  EXPECT_THAT(work_precision_script("a", rows, Cost::area), HasSubstr("$front << END\n1 50\nEND\n"));
  EXPECT_THAT(work_precision_script("a", rows, Cost::area_run_time), HasSubstr("$front << END\n9 50\nEND\n"));
}

/// As large as a unit of one box, a pair is on the front alone.
TEST(WorkPrecisionDiagram, HasTheFrontOfAreasForEachBox) {
  const std::vector rows{row("int_slabs", "20/24", 1001), pair_row(1001)};
  EXPECT_THAT(work_precision_script("a", rows, Cost::area), HasSubstr("$front << END\n1 0.1\nEND\n"));
  EXPECT_THAT(work_precision_script("a", rows, Cost::area),
              HasSubstr("set xlabel 'area, mm² for each box tested in a cycle'"));
}

TEST(SweepRows, TheSixUnitsOfTheThesisAreKnown) {
  EXPECT_TRUE(is_thesis_unit(row("fp_plucker", "fp32", 1)));
  EXPECT_TRUE(is_thesis_unit(row("int_slabs", "24/24", 1)));
  EXPECT_FALSE(is_thesis_unit(row("int_slabs", "24/28", 1)));
}

TEST(SweepRows, UsualRaysInFlightAreThoseOfMostRows) {
  std::vector<sim::SweepRow> rows(5, row("int_slabs", "20/24", 1));
  rows[0].rays_in_flight = 1;
  rows[1].rays_in_flight = 2;
  EXPECT_EQ(usual_rays_in_flight(rows), 32);
  rows[2].rays_in_flight = 1;
  EXPECT_EQ(usual_rays_in_flight(std::vector(rows.begin(), rows.begin() + 4)), 1);
  EXPECT_EQ(usual_rays_in_flight(std::vector(rows.begin() + 1, rows.begin() + 3)), 2);
}

TEST(WorkPrecisionDiagram, HasTheSameAxesWhateverTheRows) {
  const std::string axes = "set xrange [0.05:10]\nset yrange [5e-05:1000]\n";
  EXPECT_THAT(work_precision_script("a", std::vector{row("int_slabs", "20/24", 1001)}, Cost::area),
              HasSubstr(axes));
  EXPECT_THAT(work_precision_script("b", std::vector{row("int_plucker", "8/8", 900'000)}, Cost::area),
              HasSubstr(axes));
}

TEST(WorkPrecisionDiagram, DrawsOnTheAxisWhatIsBeyondIt) {
  const std::vector rows{row("fp_slabs", "fp32", 1000), row("int_slabs", "8/8", 900'000)};
  EXPECT_THAT(work_precision_script("a", rows, Cost::area), HasSubstr("2 0.0001\n"));
  EXPECT_THAT(work_precision_script("a", rows, Cost::area), HasSubstr("2 1000\n"));
}

TEST(WorkPrecisionDiagram, LabelsTheUnitsOfTheThesisAlone) {
  const std::vector rows{row("int_slabs", "20/24", 1001), row("int_slabs", "16/16", 1100)};
  const std::string script = work_precision_script("a", rows, Cost::run_time);
  EXPECT_THAT(script, HasSubstr("set label 'int_slabs 20/24' at graph "));
  EXPECT_THAT(script, Not(HasSubstr("16/16")));
}

/// The plot keeps its size, so that it lies on that of another report.
TEST(WorkPrecisionDiagram, GrowsWithItsKey) {
  std::vector<sim::SweepRow> rows;
  for (const char* const design : {"fp_slabs", "int_slabs", "fp_plucker", "int_plucker"})
    rows.push_back(row(design, rows.size() % 2 == 0 ? "fp32" : "20/24", 1001));
  EXPECT_THAT(work_precision_script("a", rows, Cost::area), HasSubstr("set terminal svg size 760,601 "));
  rows.push_back(row("fp_plucker_direct", "fp32", 1001));
  rows.push_back(row("int_major", "20+1/12", 1001));
  rows.push_back(pair_row(1001));
  EXPECT_THAT(work_precision_script("a", rows, Cost::area), HasSubstr("set terminal svg size 760,647 "));
}

TEST(OccupancyDiagram, HasALineForEachUnitOfTheThesis) {
  std::vector<sim::SweepRow> rows(3, row("int_slabs", "20/24", 1000));
  rows[1].rays_in_flight = 64;
  rows[2].bits = "16/16";
  const std::string script = occupancy_script("a", rows);
  EXPECT_THAT(script, HasSubstr("$unit0 << END\n32 50\n64 50\nEND\n"));
  EXPECT_THAT(script, HasSubstr("title 'int_slabs 20/24'"));
  EXPECT_THAT(script, Not(HasSubstr("16/16")));
}

}  // namespace
}  // namespace hitpipe::cli
