// Labels of marks: near them, and on nothing else.
#include "cli/report/label_places.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace hitpipe::cli::label_places_test {
namespace {

constexpr double half_height = 7.5;
constexpr Mark size{600, 400};

bool within(const LabelPlace& p, const Mark& at, double margin = 0) {
  return at.x > p.left - margin && at.x < p.right + margin &&
         std::abs(at.y - p.middle) < half_height + margin;
}

/// Every label is inside the plot and covers nothing, and every line leads past all marks and labels but its
/// own.
void expect_readable(const std::vector<Mark>& marks, const std::vector<std::string>& texts) {
  const std::vector<LabelPlace> places = place_labels(marks, texts, size);
  ASSERT_EQ(places.size(), texts.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const LabelPlace& p = places[i];
    EXPECT_TRUE(p.clear) << texts[i];
    EXPECT_NEAR(p.right - p.left, text_width(texts[i]), 1e-9);
    EXPECT_GE(p.left, 0) << texts[i];
    EXPECT_LE(p.right, size.x) << texts[i];
    EXPECT_GE(p.middle, half_height) << texts[i];
    for (const Mark& mark : marks)
      EXPECT_FALSE(within(p, mark)) << texts[i] << " lies on the mark at " << mark.x << ", " << mark.y;
    for (std::size_t j = 0; j < places.size(); ++j) {
      if (j == i) continue;
      EXPECT_FALSE(p.left < places[j].right && places[j].left < p.right &&
                   std::abs(p.middle - places[j].middle) < 2 * half_height)
          << texts[i] << " lies on " << texts[j];
      for (double along = 0; p.line && along <= 1; along += 1.0 / 512) {
        const Mark point{std::lerp(marks[i].x, p.anchor(), along), std::lerp(marks[i].y, p.middle, along)};
        ASSERT_FALSE(within(places[j], point)) << "the line of " << texts[i] << " crosses " << texts[j];
        ASSERT_GT(std::hypot(point.x - marks[j].x, point.y - marks[j].y), mark_radius / 2)
            << "the line of " << texts[i] << " crosses the mark of " << texts[j];
      }
    }
  }
}

TEST(LabelPlaces, CoverNeitherEachOtherNorAMark) {
  expect_readable({{100, 20}, {113, 20}, {126, 20}, {112, 33}, {300, 100}},
                  {"int_slabs 24/24", "fp_slabs", "fp_plucker", "int_plucker 20/24"});
}

/// The lowest row of a diagram has the units without any error, side by side.
TEST(LabelPlaces, ARowOfMarksAtTheBottomIsReadable) {
  std::vector<Mark> marks;
  const std::vector<std::string> texts{"24/28,32",    "24/28,32",    "28/28,32,36",
                                       "28/28,32,36", "fp_slabs",    "e8m23",
                                       "fp_plucker",  "32/32,36,40", "fp_plucker_direct"};
  for (std::size_t i = 0; i < texts.size(); ++i) marks.push_back({250.0 + 12.5 * static_cast<double>(i), 35});
  expect_readable(marks, texts);
  // At the right edge.
  for (Mark& mark : marks) mark.x += 240;
  expect_readable(marks, texts);
}

TEST(LabelPlaces, ALoneLabelIsBesideItsMark) {
  const std::vector<Mark> marks{{100, 200}, {590, 200}};
  const std::vector<std::string> texts{"24/24", "20/24"};
  const std::vector<LabelPlace> places = place_labels(marks, texts, size);
  EXPECT_EQ(places[0].align, Align::left);
  EXPECT_EQ(places[0].anchor(), 109);
  EXPECT_EQ(places[1].align, Align::right) << "there is no room on the right";
  EXPECT_EQ(places[1].anchor(), 581);
  for (const LabelPlace& p : places) {
    EXPECT_EQ(p.middle, 200);
    EXPECT_FALSE(p.line);
  }
}

bool meets(const LabelPlace& p, const PlotSegment& line) {
  for (double along = 0; along <= 1; along += 1.0 / 512)
    if (within(p, {std::lerp(line.from.x, line.to.x, along), std::lerp(line.from.y, line.to.y, along)}))
      return true;
  return false;
}

TEST(LabelPlaces, LieOnNoLineOfThePlot) {
  const std::vector<Mark> marks{{100, 200}, {300, 200}};
  const std::vector<PlotSegment> lines{{marks[0], marks[1]}, {{100, 300}, {100, 200}}};
  const std::vector<std::string> texts{"int_slabs 24/24", "20/24"};
  for (const LabelPlace& p : place_labels(marks, texts, size, lines)) {
    EXPECT_TRUE(p.clear);
    for (const PlotSegment& line : lines) EXPECT_FALSE(meets(p, line));
  }
}

/// Marks may cover one another; their labels are beside all of them.
TEST(LabelPlaces, OfMarksAtOnePlaceAreReadable) {
  const std::vector<Mark> marks{{100, 200}, {100, 200, 12}, {101, 201}};
  const std::vector<std::string> texts{"int_slabs 24/24", "fp_slabs", "fp_plucker"};
  for (const LabelPlace& p : place_labels(marks, texts, size)) {
    EXPECT_TRUE(p.clear);
    EXPECT_FALSE(p.left < 112 && p.right > 88 && std::abs(p.middle - 200) < 12 + half_height);
  }
}

TEST(LabelPlaces, WithoutRoomAreNotClear) {
  const std::vector<Mark> marks{{20, 24}, {22, 24}, {24, 24}};
  const std::vector<std::string> texts{"24/24", "24/28", "24/32"};
  const std::vector<LabelPlace> places = place_labels(marks, texts, {60, 30});
  EXPECT_EQ(std::ranges::count(places, true, &LabelPlace::clear), 1);
  EXPECT_TRUE(places[0].clear);
}

TEST(TextWidth, TellsWideLettersFromNarrowOnes) {
  EXPECT_LT(text_width("fill"), text_width("swam"));
  EXPECT_GE(text_width("20+1/12"), 52) << "measured in DejaVu Sans";
  EXPECT_GE(text_width("e5m10"), 42);
  EXPECT_DOUBLE_EQ(text_width("≤ 0"), text_width("e 0")) << "a letter of three bytes";
}

}  // namespace
}  // namespace hitpipe::cli::label_places_test
