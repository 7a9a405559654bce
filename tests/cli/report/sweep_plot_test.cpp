// Diagrams of a sweep: which units are on the front, where marks and their names are, and where axes end.
#include "cli/report/sweep_plot.hpp"

#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/plot.hpp"
#include "cli/report/sweep_rows.hpp"
#include "rtl_gen/catalogue/design.hpp"

namespace hitpipe::cli::sweep_plot_test {
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

const Diagram& diagram(std::string_view name) {
  return *std::ranges::find(diagrams(false), name, &Diagram::name);
}

/// One format of each design: its default, or else the last.
TEST(Rates, AreaAgainstRateHasAMarkForEachInterval) {
  std::vector<sim::SweepRow> rows{row("int_slabs", "6/6", 1000),   row("int_slabs", "6/6", 1000),
                                  row("int_slabs", "24/24", 1000), row("int_slabs", "24/24", 1000),
                                  row("fp_slabs", "fp32", 1000),   row("fp_slabs", "fp32", 1000)};
  EXPECT_EQ(rate_script("a", std::vector{rows[0], rows[2], rows[4]}), "") << "one interval each";
  const std::array<std::int64_t, 6> areas{500'000, 250'000, 2'000'000, 1'000'000, 4'000'000, 1'500'000};
  const std::array intervals{1, 3, 1, 3, 1, 6};
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].stage_delay_ps = 2500;
    rows[i].interval = intervals[i];
    rows[i].area_um2 = areas[i];
  }
  const std::string script = rate_script("a", rows);
  EXPECT_THAT(script, HasSubstr("$unit0 << END\n400 4\n66.6667 1.5\nEND\n"));
  EXPECT_THAT(script, HasSubstr("$unit1 << END\n400 2\n133.333 1\nEND\n"));
  EXPECT_THAT(script, HasSubstr("$front << END\n400 2\n133.333 1\nEND\n"));
  EXPECT_THAT(script, HasSubstr("title 'int_slabs 24/24'"));
  for (const char* const name : {"'1'", "'3'", "'6'"})
    EXPECT_THAT(script, HasSubstr(std::string("set label ") + name));
  rows[1].bits = rows[0].bits = "20/24";
  EXPECT_THAT(rate_script("a", rows), HasSubstr("title 'int_slabs 20/24'")) << "the default format";
  EXPECT_EQ(unit_name(rows[1]), "int_slabs 20/24 II 3");
}

TEST(Diagrams, ShowColumnsOfTheRowsFile) {
  for (const bool on_chip : {false, true}) {
    for (const Diagram& each : diagrams(on_chip)) {
      for (const std::string_view column : {each.cost, each.error})
        EXPECT_FALSE(sim::sweep_column(column).is_text()) << each.name;
      EXPECT_EQ(each.cost.find("mm2") != std::string_view::npos && on_chip, false) << each.name;
    }
    EXPECT_EQ(diagrams(on_chip).size(), 6U);
  }
}

/// A pair needs half the cycles. So its area is halved once: in the area for each box, and not again in area
/// times run time.
TEST(SweepRows, APairCountsTwoBoxes) {
  const sim::SweepRow unit = pair_row(1500);
  EXPECT_DOUBLE_EQ(unit.extra_box_tests_pct(), 50);
  EXPECT_DOUBLE_EQ(unit.occupancy_pct(), 50);
  EXPECT_EQ(cell(unit, "area_mm2"), "2.000000");
  EXPECT_EQ(cell(unit, "area_per_box_mm2"), "1");
  const std::vector rows{unit};
  EXPECT_THAT(diagram_script("a", rows, diagram("error_area")), HasSubstr("$front << END\n1 50\nEND\n"));
  EXPECT_THAT(diagram_script("a", rows, diagram("error_area_run_time")),
              HasSubstr("$front << END\n0.009 50\nEND\n"));
}

/// As large as a unit of one box, a pair is on the front alone.
TEST(Diagram, HasTheFrontOfAreasForEachBox) {
  const std::vector rows{row("int_slabs", "20/24", 1001), pair_row(1001)};
  const std::string script = diagram_script("a", rows, diagram("error_area"));
  EXPECT_THAT(script, HasSubstr("$front << END\n1 0.1\nEND\n"));
  EXPECT_THAT(script, HasSubstr("set xlabel 'area for each box tested in a cycle, mm²'"));
}

/// By box tests alone the small unit is cheaper. With its false hits it is not.
TEST(Diagram, OfTheWholeHasAnotherFrontThanThatOfBoxTests) {
  sim::SweepRow small = row("int_slabs", "8/8", 1100);
  small.area_um2 = 500'000;
  small.triangle_tests = 900;
  sim::SweepRow large = row("int_slabs", "16/16", 1010);
  large.triangle_tests = 101;
  small.reference_triangle_tests = large.reference_triangle_tests = 100;
  small.triangle = large.triangle = {.delay_ps = 3000, .area_um2 = 8'000'000};
  const std::vector rows{small, large};
  EXPECT_LT(small.area_run_time_mm2_ms(), large.area_run_time_mm2_ms());
  EXPECT_THAT(diagram_script("a", rows, diagram("error_area_run_time")),
              HasSubstr("$front << END\n0.0033 10\n0.01212 1\nEND\n"));
  EXPECT_THAT(diagram_script("a", rows, diagram("whole_area_run_time")),
              HasSubstr("$front << END\n0.014544 1\nEND\n"));
  EXPECT_EQ(cheapest_boxes(rows, 32), 0U);
  EXPECT_EQ(cheapest(rows, 32), 1U);
  EXPECT_EQ(cheapest(rows, 32, 0.5), std::nullopt);
  EXPECT_EQ(cheapest(rows, 8), std::nullopt);
  const std::vector<std::string> lines = recommendation(rows);
  ASSERT_EQ(lines.size(), 2U);
  EXPECT_THAT(lines[0],
              testing::StartsWith("Least whole area × time: int_slabs 16/16: 0.01454 mm² ms, of box "
                                  "tests alone 0.01212; 1 % extra triangle tests, "));
  EXPECT_THAT(lines[1],
              testing::StartsWith("By box tests alone it would be int_slabs 8/8, which costs 71.2 % "
                                  "more as a whole: "));
  EXPECT_THAT(cost_caveat(small), HasSubstr("A triangle test is taken as 3 ns of a unit of 8 mm²."));
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

TEST(LogAxis, EndsWhereTheDataDoes) {
  const LogAxis axis(std::vector<double>{0.5, 20, 3});
  EXPECT_LT(axis.least(), 0.5);
  EXPECT_GT(axis.least(), 0.4);
  EXPECT_GT(axis.most(), 20);
  EXPECT_LT(axis.most(), 25);
  EXPECT_NEAR(axis.at(axis.share(3)), 3, 1e-12);
  EXPECT_EQ(axis.tics(), "'0.5' 0.5, '1' 1, '2' 2, '5' 5, '10' 10, '20' 20");
  const LogAxis narrow(std::vector<double>{1, 1.6});
  EXPECT_EQ(narrow.tics(), "'1' 1, '1.1' 1.1, '1.2' 1.2, '1.3' 1.3, '1.4' 1.4, '1.6' 1.6");
  const LogAxis one(std::vector<double>{7});
  EXPECT_LT(one.least(), 7);
  EXPECT_GT(one.most(), 7);
}

TEST(LogAxis, HasAPlaceForWhatIsNotPositive) {
  const LogAxis axis(std::vector<double>{-1, 0, 10, 1000});
  EXPECT_EQ(axis.shown(-1), axis.shown(0));
  EXPECT_LT(axis.shown(0), 10);
  EXPECT_GT(axis.share(0), 0);
  EXPECT_NEAR(axis.shown(0), 10 / std::pow(100, 0.3), 1e-12);
  // Labels have room below and above the units there.
  EXPECT_GT(axis.share(0), 0.06);
  EXPECT_GT(axis.share(10) - axis.share(0), 0.2);
  EXPECT_THAT(axis.tics(), testing::StartsWith("'≤ 0' 2.51"));
  EXPECT_THAT(axis.tics(), HasSubstr(", '10' 10, "));
  const LogAxis nothing(std::vector<double>{0, 0});
  EXPECT_GT(nothing.share(0), 0);
  EXPECT_LT(nothing.share(0), 1);
}

TEST(Diagram, NamesEveryUnitBesideItsMark) {
  sim::SweepRow close = row("int_slabs", "24/28", 1001);
  close.area_um2 = 2'001'000;
  sim::SweepRow far = row("int_slabs", "16/16", 1100);
  far.area_um2 = 1'000'000;
  const std::vector rows{row("fp_slabs", "fp32", 900), row("int_slabs", "24/24", 1001), close, far};
  const std::string script = diagram_script("a", rows, diagram("error_area"));
  for (const char* const name : {"'fp_slabs'", "'24/24,28'", "'16/16'"})
    EXPECT_THAT(script, HasSubstr("set label " + std::string(name) + " at graph "));
}

/// Marks of two designs at the same place stand side by side, one of a design names its formats.
TEST(UnitMarks, DoNotCoverOneAnother) {
  const std::vector rows{row("int_slabs", "20/24", 1), row("int_plucker", "20/24", 1),
                         row("int_slabs", "20/28", 1), row("int_slabs", "16/16", 1),
                         row("fp_slabs", "fp32", 1)};
  const std::vector<Mark> places{{100, 50}, {101, 51}, {103, 50}, {300, 50}, {106, 44}};
  const std::vector<UnitMark> marks = unit_marks(rows, places);
  ASSERT_EQ(marks.size(), 4U);
  EXPECT_EQ(marks[0].name, "20/24,28");
  EXPECT_EQ(marks[1].name, "20/24");
  EXPECT_EQ(marks[2].name, "16/16");
  EXPECT_EQ(marks[3].name, "fp_slabs");
  EXPECT_EQ(marks[2].place.x, 300);
  for (std::size_t i = 0; i < marks.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(std::hypot(marks[i].place.x - marks[j].place.x, marks[i].place.y - marks[j].place.y),
                2 * mark_radius - 1e-6)
          << i << " " << j;
  }
}

/// Shapes tell the first designs apart without colour.
TEST(Diagram, HasAStyleForEachDesign) {
  std::set<DesignStyle> styles;
  std::set<int> shapes;
  for (std::size_t place = 0; place < 300; ++place) {
    styles.insert(design_style(place));
    if (place < 12) shapes.insert(design_style(place).shape);
  }
  EXPECT_EQ(styles.size(), 300U);
  EXPECT_EQ(shapes.size(), 12U);
  std::vector<sim::SweepRow> rows;
  for (const rtl::Design& design : rtl::designs())
    rows.push_back(row(std::string(design.name), rtl::to_string(design.default_format), 1001));
  const std::string script = diagram_script("a", rows, diagram("error_area"));
  for (std::size_t place = 0; place < rows.size(); ++place) {
    const DesignStyle style = design_style(place);
    EXPECT_THAT(script,
                HasSubstr(fmt::format("lc rgb '{}' pt {} ps {:g} ", style.colour, style.shape, style.size)));
  }
}

/// The plot keeps its size.
TEST(Diagram, GrowsWithItsKey) {
  std::vector<sim::SweepRow> rows;
  for (const char* const design : {"fp_slabs", "int_slabs"})
    rows.push_back(row(design, rows.size() % 2 == 0 ? "fp32" : "20/24", 1001));
  EXPECT_THAT(diagram_script("a", rows, diagram("error_area")), HasSubstr("set terminal svg size 1000,592 "));
  rows.push_back(row("fp_plucker", "fp32", 1001));
  EXPECT_THAT(diagram_script("a", rows, diagram("error_area")), HasSubstr("set terminal svg size 1000,612 "));
}

/// Units whose lines would lie on one another share one.
TEST(OccupancyDiagram, HasALineForUnitsThatDiffer) {
  std::vector<sim::SweepRow> rows(2, row("int_slabs", "20/24", 1000));
  rows[1].rays_in_flight = 64;
  for (int i = 0; i < 2; ++i) {
    rows.push_back(rows[static_cast<std::size_t>(i)]);
    rows.back().design = "int_plucker";
    rows.push_back(rows[static_cast<std::size_t>(i)]);
    rows.back().bits = "24/24";
    rows.back().cycles *= 2;
    rows.push_back(rows[static_cast<std::size_t>(i)]);
    rows.back().bits = "16/16";  // none of the thesis's
  }
  const std::string script = occupancy_script("a", rows);
  EXPECT_THAT(script, HasSubstr("$unit0 << END\n32 50\n64 50\nEND\n"));
  EXPECT_THAT(script, HasSubstr("title 'int_slabs 20/24, int_plucker 20/24'"));
  EXPECT_THAT(script, HasSubstr("title 'int_slabs 24/24'"));
  EXPECT_THAT(script, HasSubstr("set xrange [30.4:67.2]\nset yrange [0:101]\nset xtics (32,64)\n"));
  EXPECT_THAT(script, Not(HasSubstr("16/16")));
  EXPECT_EQ(occupancy_script("a", std::vector{row("int_slabs", "20/24", 1000)}), "");
}

}  // namespace
}  // namespace hitpipe::cli::sweep_plot_test
