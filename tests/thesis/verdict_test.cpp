#include "thesis/verdict.hpp"

#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace hitpipe::thesis::verdict_test {
namespace {

Comparison percents(double printed, double ours) {
  return {"more tests, %", printed, ours, 0.5};
}

TEST(Verdict, ComparesTheFigureThatTheClaimIsAbout) {
  EXPECT_EQ(verdict_of(percents(1631, 37)), Verdict::differs);
  EXPECT_EQ(verdict_of(percents(26, 108)), Verdict::differs);
  EXPECT_EQ(verdict_of(percents(52, 117)), Verdict::same_order);
  EXPECT_EQ(verdict_of(percents(75, 75.4)), Verdict::agrees);
}

TEST(Verdict, ChangesAtItsTwoFactorsInBothDirections) {
  EXPECT_EQ(verdict_of({"", 100, 125}), Verdict::agrees);
  EXPECT_EQ(verdict_of({"", 100, 125.1}), Verdict::same_order);
  EXPECT_EQ(verdict_of({"", 125, 100}), Verdict::agrees);
  EXPECT_EQ(verdict_of({"", 125.1, 100}), Verdict::same_order);
  EXPECT_EQ(verdict_of({"", 100, 300}), Verdict::same_order);
  EXPECT_EQ(verdict_of({"", 300.1, 100}), Verdict::differs);
}

TEST(Verdict, PrintedFigureStandsForAllThatIsRoundedToIt) {
  EXPECT_EQ(factor_between(percents(0, 0.4)), 1.0);
  EXPECT_DOUBLE_EQ(factor_between(percents(0, 0.6)), 1.2);
  EXPECT_DOUBLE_EQ(factor_between(percents(1, 3)), 2.0);
  EXPECT_EQ(factor_between({"", 0, 0}), 1.0);
}

TEST(Verdict, OtherSignDiffers) {
  EXPECT_EQ(verdict_of(percents(22, -12)), Verdict::differs);
  EXPECT_EQ(verdict_of(percents(1, -0.1)), Verdict::differs);
  EXPECT_EQ(verdict_of({"wrong answers", 0, 1}), Verdict::differs);
  EXPECT_EQ(verdict_text(percents(22, -12)), "differs, other sign");
}

TEST(Verdict, TextHasTheDistance) {
  EXPECT_EQ(verdict_text(percents(10, 10.2)), "agrees");
  EXPECT_EQ(verdict_text({"", 100, 107.2}), "agrees within 8 %");
  EXPECT_EQ(verdict_text({"", 100, 230}), "same order, factor 2.3");
  EXPECT_EQ(verdict_text(percents(1631, 37)), "differs, factor 44");
}

TEST(Verdict, WorstFigureDecides) {
  const std::vector<Comparison> figures{percents(10, 11), percents(1631, 37), percents(3, 6)};
  EXPECT_EQ(worst_of(figures).printed, 1631);
}

TEST(FigureText, HasItsIntervalAndWholeThousands) {
  EXPECT_EQ(figure_text(37.14), "37.1");
  EXPECT_EQ(figure_text(1631), "1631");
  EXPECT_EQ(figure_text(37.14, Interval{35.2, 39.01}), "37.1 (35.2 to 39)");
}

}  // namespace
}  // namespace hitpipe::thesis::verdict_test
