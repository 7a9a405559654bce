// Occupancy against rays in flight: a line for each unit.
#include "cli/report/occupancy_plot.hpp"

#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/cli/report/swept_row.hpp"

namespace hitpipe::cli::occupancy_plot_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Units whose lines nearly lie on one another share a style, each at its values.
TEST(OccupancyDiagram, HasAStyleForUnitsThatDiffer) {
  std::vector<sim::SweepRow> rows(2, row("int_slabs", "20/24", 1000));
  rows[1].rays_in_flight = 64;
  for (int i = 0; i < 2; ++i) {
    rows.push_back(rows[static_cast<std::size_t>(i)]);
    rows.back().design = "int_plucker";
    rows.back().cycles += 10;
    rows.push_back(rows[static_cast<std::size_t>(i)]);
    rows.back().bits = "24/24";
    rows.back().cycles *= 2;
    rows.push_back(rows[static_cast<std::size_t>(i)]);
    rows.back().bits = "16/16";  // none of the thesis's
  }
  const std::optional<Picture> picture = occupancy_picture("a", rows, report_form);
  ASSERT_TRUE(picture);
  const std::string script = picture_script(*picture, report_form);
  EXPECT_THAT(script, HasSubstr("$unit0_0 << END\n32 50\n64 50\nEND\n"));
  EXPECT_THAT(script, HasSubstr("$unit0_1 << END\n32 49.75"));
  EXPECT_THAT(script, HasSubstr("$unit1_0 << END\n32 25\n64 25\nEND\n"));
  for (const char* const line :
       {"$unit0_0 using 1:2 with linespoints lc rgb '#D55E00' pt 5 ps 0.9 lw 1.5 dt 1 title "
        "'int_slabs 20/24'",
        "$unit0_1 using 1:2 with linespoints lc rgb '#D55E00' pt 5 ps 0.9 lw 1.5 dt 1 title "
        "'int_plucker 20/24'",
        "title 'int_slabs 24/24'"})
    EXPECT_THAT(script, HasSubstr(line));
  EXPECT_THAT(script, HasSubstr("set xrange [30.4:67.2]\nset yrange [0:101]\nset xtics (32,64)\n"));
  EXPECT_THAT(script, Not(HasSubstr("16/16")));
  EXPECT_FALSE(occupancy_picture("a", std::vector{row("int_slabs", "20/24", 1000)}, report_form));
}

}  // namespace
}  // namespace hitpipe::cli::occupancy_plot_test
