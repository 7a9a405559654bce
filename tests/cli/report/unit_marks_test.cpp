// Marks: where their values are, all of them seen, and named.
#include "cli/report/unit_marks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::cli::unit_marks_test {
namespace {

using testing::HasSubstr;
using testing::Not;

PlotMark mark(const std::string& design, const std::string& name, Mark place) {
  return {design, name, style_of(design), place.x, place.y, place};
}

/// Places are their values here.
std::vector<PlotMark> crowd() {
  return {mark("int_slabs", "20/24", {100, 50}), mark("int_plucker", "20/24", {101, 51}),
          mark("int_slabs", "20/28", {104, 50}), mark("int_slabs", "16/16", {300, 50}),
          mark("fp_slabs", "fp32", {106, 44})};
}

TEST(UnitMarks, AreDrawnWhereTheyAreAndTheLargeOnesBelow) {
  std::vector<PlotMark> marks = crowd();
  enlarge_hidden(marks);
  EXPECT_EQ(marks_data(marks),
            "$marks << END\n"
            "104 50 1.71 5 0xD55E00 \"int_slabs\" \"20/28\"\n"
            "101 51 1.305 13 0x000000 \"int_plucker\" \"20/24\"\n"
            "100 50 0.9 5 0xD55E00 \"int_slabs\" \"20/24\"\n"
            "300 50 0.9 5 0xD55E00 \"int_slabs\" \"16/16\"\n"
            "106 44 0.9 7 0x0072B2 \"fp_slabs\" \"fp32\"\n"
            "END\n");
}

/// Units of a design share a label where their marks cover one another.
TEST(UnitMarks, LabelsStandAtOneOfTheirUnits) {
  const std::vector<PlotMark> marks = crowd();
  const std::vector<MarkLabel> labels = unit_labels(marks);
  ASSERT_EQ(labels.size(), 4U);
  EXPECT_EQ(labels[0].text, "int_slabs 20/24,28") << "marks of two designs cover one another there";
  EXPECT_TRUE(labels[0].mark == 0 || labels[0].mark == 2);
  EXPECT_EQ(labels[1].text, "int_plucker 20/24");
  EXPECT_EQ(labels[1].mark, 1U);
  EXPECT_EQ(labels[2].text, "16/16");
  EXPECT_EQ(labels[2].mark, 3U);
  EXPECT_EQ(labels[3].text, "fp_slabs");
  EXPECT_EQ(labels[3].mark, 4U);
}

TEST(UnitMarks, LabelsMoveAndALineLeadsToTheMark) {
  const std::vector<PlotMark> marks = crowd();
  const PlacedLabels labels = place_mark_labels(unit_labels(marks), marks, {}, {400, 100});
  EXPECT_EQ(labels.left_out, 0U);
  EXPECT_THAT(labels.settings, HasSubstr("set label '16/16' at graph 0.7725,0.5000 left front boxed\n"));
  EXPECT_THAT(labels.settings, HasSubstr("set arrow from graph 0.2525,0.5100 to graph ")) << "int_plucker's";
}

TEST(UnitMarks, ALabelWithoutRoomIsLeftOut) {
  std::vector<PlotMark> marks(9, mark("int_slabs", "20/24", {20, 20}));
  for (std::size_t i = 0; i < marks.size(); ++i) marks[i].name = std::to_string(100000 + i);
  const PlacedLabels labels = place_mark_labels(name_labels(marks), marks, {}, {80, 60});
  EXPECT_GT(labels.left_out, 4U);
  EXPECT_LT(labels.left_out, 9U) << "those that have room stay";
  EXPECT_THAT(labels.settings, Not(HasSubstr("'100008'")));
}

}  // namespace
}  // namespace hitpipe::cli::unit_marks_test
