// What plots share: texts in lines, the room of a plot and of its key.
#include "cli/report/plot.hpp"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::cli::plot_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(GnuplotString, IsTakenLiterally) {
  EXPECT_EQ(gnuplot_string("it's `date`"), "'it''s `date`'");
  EXPECT_EQ(gnuplot_string(std::vector<std::string>{"a", "it's"}), "'a'.\"\\n\".'it''s'");
}

TEST(LinesWithin, BreakAtBlanks) {
  const std::string text = "run time of the box tests, ms";
  EXPECT_THAT(lines_within(text, 1000), ElementsAre(text));
  EXPECT_THAT(lines_within(text, text_width("run time of the")),
              ElementsAre("run time of the", "box tests, ms"));
  EXPECT_THAT(lines_within("unbroken", 1), ElementsAre("unbroken"));
}

/// Shapes tell the first designs apart without colour.
TEST(DesignStyle, IsOfOneDesign) {
  std::set<DesignStyle> styles;
  std::set<int> shapes;
  for (std::size_t place = 0; place < 300; ++place) {
    styles.insert(design_style(place));
    if (place < 12) shapes.insert(design_style(place).shape);
  }
  EXPECT_EQ(styles.size(), 300U);
  EXPECT_EQ(shapes.size(), 12U);
}

TEST(PlotFrame, PictureGrowsWithItsKey) {
  const auto frame = [](std::size_t keys) {
    return plot_frame(report_form, "x", "y", std::vector<std::string>(keys, "int_slabs"));
  };
  EXPECT_EQ(frame(3).picture_height, frame(1).picture_height);
  EXPECT_EQ(frame(4).picture_height, frame(3).picture_height + 18);
  EXPECT_EQ(frame(4).size.y, frame(3).size.y);
  EXPECT_THAT(frame(4).settings, HasSubstr(" maxcols 3\n"));
}

/// Labels of axes that are too long have two lines, and the key has fewer columns.
TEST(PlotFrame, OfAPaperHasLessRoom) {
  const std::vector<std::string> keys(4, "fp_plucker_direct");
  const std::string label = "extra box tests, % above conservative float slabs";
  const PlotFrame frame = plot_frame(paper_form(84), label, label, keys);
  EXPECT_THAT(frame.settings, HasSubstr(" maxcols 1\n"));
  EXPECT_THAT(frame.settings,
              HasSubstr("set xlabel 'extra box tests, % above'.\"\\n\".'conservative float slabs'\n"));
  EXPECT_LT(frame.size.x, paper_form(84).width() - tic_texts_width);
  EXPECT_GT(frame.size.y, 0.9 * frame.size.x) << "labels find room above one another";
}

}  // namespace
}  // namespace hitpipe::cli::plot_test
