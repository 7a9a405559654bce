// A stiffness report's picture: panels on a grid, axes and key in common.
#include "cli/report/stiffness_plot.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::cli::stiffness_plot_test {
namespace {

using testing::HasSubstr;

std::size_t times(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++count;
  return count;
}

/// All panels but the last have the same two formats.
Plot plot(std::size_t panels) {
  Plot made{"stiffness", "title", "false hits", {0, 10, 20, 30, 40}, {}, 0.01};
  const PlotLine line{"24/24", {0.02, 0.5, 2, 7, 8, 90}};
  for (std::size_t i = 0; i < panels; ++i)
    made.panels.push_back(
        {fmt::format("design{}", i), {line, {i + 1 < panels ? "16/16" : "e5m10", line.percent}}});
  return made;
}

TEST(StiffnessPicture, HasThreeColumnsWhereTheyHaveRoom) {
  const std::string wide = stiffness_picture(plot(6), page_form).plots;
  EXPECT_EQ(times(wide, "set lmargin at screen 0.09"), 2U) << "rows";
  EXPECT_EQ(times(wide, "'≤ 0.01' 0.01"), 2U) << "texts at the first panel of each row";
  EXPECT_EQ(times(wide, "'zero' "), 3U) << "texts below the last panel of each column";
  EXPECT_THAT(wide, HasSubstr("'2⁰' 0, '2¹⁰' 10, '2²⁰' 20, '2³⁰' 30, '2⁴⁰' 40, 'zero' "));
  const std::string narrow = stiffness_picture(plot(6), paper_form(84)).plots;
  EXPECT_EQ(times(narrow, "'≤ 0.01' 0.01"), 3U);
  EXPECT_EQ(times(narrow, "'zero' "), 2U);
  EXPECT_THAT(narrow, HasSubstr("'2⁰' 0, '2²⁰' 20, '2⁴⁰' 40, 'zero' "));
  EXPECT_EQ(times(stiffness_picture(plot(3), paper_form(40)).plots, "'≤ 0.01' 0.01"), 3U);
}

/// A format has one style in all panels, and each is in the key once.
TEST(StiffnessPicture, HasOneKey) {
  const std::string plots = stiffness_picture(plot(6), page_form).plots;
  EXPECT_EQ(times(plots, "keyentry "), 3U);
  for (const char* const title : {"title '24/24'", "title '16/16'", "title 'e5m10'"})
    EXPECT_EQ(times(plots, title), 1U);
  EXPECT_EQ(times(plots, "with linespoints lc rgb '#0072B2' pt 7"), 7U)
      << "24/24 in six panels and in the key";
  EXPECT_EQ(times(plots, "'ratio of direction components'"), 1U);
  EXPECT_EQ(times(plots, "set label 1 'false hits, %'"), 1U);
}

TEST(StiffnessPicture, IsDrawnWithTheNamesOfItsPanels) {
  const DrawnPicture drawn =
      draw_picture("check", stiffness_picture(plot(5), paper_form(84)), paper_form(84));
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(times(drawn.svg, fmt::format(">design{}<", i)), 1U);
  EXPECT_THAT(drawn.svg, testing::Not(HasSubstr(">title<")));
  EXPECT_THAT(drawn.pdf, testing::StartsWith("%PDF"));
}

}  // namespace
}  // namespace hitpipe::cli::stiffness_plot_test
