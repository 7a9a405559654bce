// Diagrams of a sweep: which units are on the front, where marks and their names are, and where axes end.
#include "cli/report/sweep_plot.hpp"

#include <algorithm>
#include <iomanip>
#include <regex>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/report/plot.hpp"
#include "cli/report/sweep_rows.hpp"
#include "rtl_gen/catalogue/design.hpp"
#include "tests/cli/report/swept_row.hpp"

namespace hitpipe::cli::sweep_plot_test {
namespace {

using testing::HasSubstr;
using testing::Not;

bool operator==(const CostAndError& a, const CostAndError& b) {
  return a.cost == b.cost && a.error == b.error;
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

std::string diagram_script(const std::string& scene, std::span<const sim::SweepRow> units,
                           const Diagram& diagram) {
  return picture_script(diagram_picture(scene, units, diagram, report_form), report_form);
}
std::string rate_script(const std::string& scene, std::span<const sim::SweepRow> units) {
  const std::optional<Picture> picture = rate_picture(scene, units, report_form);
  return picture ? picture_script(*picture, report_form) : "";
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
    EXPECT_EQ(diagrams(on_chip).size(), 7U);
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
                                  "tests alone 0.01212; 1 % extra triangle tests; "));
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

TEST(Diagram, HasAStyleForEachDesign) {
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

/// However many cover one another, in a wide picture and in a narrow one.
TEST(Diagram, MarksStandWhereTheValuesAre) {
  std::vector<sim::SweepRow> rows;
  for (const char* const design : {"int_slabs", "int_plucker"}) {
    for (const char* const bits : {"20/24", "20/28", "24/24"}) {
      rows.push_back(row(design, bits, 1000 + 3 * (rows.size() % 3)));
      rows.back().area_um2 += 100 * static_cast<std::int64_t>(rows.size());
    }
  }
  rows.push_back(row("fp_slabs", "fp32", 900));
  for (const PictureForm& form : {report_form, paper_form(84)}) {
    const std::string script = picture_script(diagram_picture("a", rows, diagram("error_area"), form), form);
    std::set<std::string> expected;
    const LogAxis y(std::vector<double>{0.3, 0.6, 0});
    for (const sim::SweepRow& unit : rows)
      expected.insert(fmt::format("{:.6g} {:.6g} {} {}", unit.area_per_box_mm2(),
                                  y.shown(unit.extra_box_tests_pct()), unit.design, unit.bits));
    std::istringstream lines(script.substr(script.find("$marks << END\n")));
    std::string line;
    std::getline(lines, line);
    std::set<std::string> drawn;
    while (std::getline(lines, line) && line != "END") {
      std::istringstream cells(line);
      std::string at_x, at_y, size, shape, colour, design, bits;
      cells >> at_x >> at_y >> size >> shape >> colour >> std::quoted(design) >> std::quoted(bits);
      drawn.insert(at_x + " " + at_y + " " + design + " " + bits);
    }
    EXPECT_EQ(drawn, expected);
    EXPECT_EQ(drawn.size(), 7U);
  }
}

/// gnuplot puts them there.
TEST(Diagram, MarksOfTheSvgStandWhereTheValuesAre) {
  std::vector<sim::SweepRow> rows{row("int_slabs", "20/24", 1010), row("int_plucker", "20/24", 1010),
                                  row("fp_slabs", "fp32", 1100)};
  rows[1].area_um2 += 1000;
  rows[2].area_um2 = 4'000'000;
  const Picture picture = diagram_picture("a", rows, diagram("error_area"), report_form);
  const std::string svg = draw_picture("a", picture, report_form).svg;
  const std::vector<double> areas{2, 2.001, 4};
  const std::vector<double> errors{1, 1, 10};
  const LogAxis x(areas);
  const LogAxis y(errors);
  const PlotFrame frame =
      plot_frame(report_form, diagram("error_area").cost_label, diagram("error_area").error_label,
                 std::vector<std::string>{"int_slabs", "int_plucker", "fp_slabs", "front"});
  std::vector<std::pair<double, double>> found;
  const std::regex use("<use xlink:href='#gpPt[0-9]+' transform='translate\\(([0-9.]+),([0-9.]+)\\)");
  for (std::sregex_iterator each(svg.begin(), svg.end(), use), end; each != end; ++each)
    found.emplace_back(std::stod((*each)[1]), std::stod((*each)[2]));
  // Those of the key come last.
  ASSERT_EQ(found.size(), 6U);
  std::sort(found.begin(), found.begin() + 3);
  constexpr double right_of_plot = 15;
  constexpr double above_plot = 12;
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(found[i].first, 1000 - right_of_plot - frame.size.x * (1 - x.share(areas[i])), 0.2);
    EXPECT_NEAR(found[i].second, above_plot + frame.size.y * (1 - y.share(errors[i])), 0.2);
  }
}

TEST(Diagram, HasNoTitle) {
  const std::string script =
      diagram_script("a", std::vector{row("fp_slabs", "fp32", 1001)}, diagram("error_area"));
  EXPECT_THAT(script, testing::StartsWith("# a: error and area\n"));
  EXPECT_THAT(script, Not(HasSubstr("set title")));
}

}  // namespace
}  // namespace hitpipe::cli::sweep_plot_test
