// The vectors of a design: as many as asked, right, about half of them hits, and the same again.
#include "sim/vectors/design_vectors.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "sim/software/software.hpp"

namespace hitpipe::sim::design_vectors_test {
namespace {

constexpr std::size_t count = 600;

class DesignVectors : public testing::TestWithParam<const char*> {
 protected:
  const rtl::Design& design_ = rtl::find_design(GetParam());
  const Format format_ = design_.default_format;
  const rtl::VectorSet set_ = design_vectors(design_, format_, count, 5);
};

TEST_P(DesignVectors, AreAsManyAsAskedAndHaveTheDesignsResults) {
  EXPECT_EQ(set_.size(), count);
  const rtl::Evaluate evaluate = design_.evaluate(format_);
  for (const rtl::Vector& vector : set_.all())
    EXPECT_EQ(vector.results, rtl::with_results(vector.operands, evaluate).results);
}

TEST_P(DesignVectors, HitAboutHalfOfTheTime) {
  const std::size_t hits = rtl::hits(set_.all(), design_.results(format_));
  EXPECT_GT(hits, count / 3);
  EXPECT_LT(hits, count * 3 / 4);
}

TEST_P(DesignVectors, ComeFromEveryCategory) {
  for (const auto& category : software_of(design_).categories) {
    EXPECT_TRUE(std::any_of(set_.groups.begin(), set_.groups.end(), [&](const rtl::VectorGroup& group) {
      return group.from == category.name && !group.vectors.empty();
    })) << category.name;
  }
}

TEST_P(DesignVectors, AreTheSameForTheSameSeed) {
  const rtl::VectorSet again = design_vectors(design_, format_, count, 5);
  const rtl::VectorSet other = design_vectors(design_, format_, count, 6);
  const std::vector<hls::Result> results = design_.results(format_);
  const auto operands = [](const rtl::VectorSet& set) {
    std::vector<std::vector<std::int64_t>> all;
    for (const rtl::Vector& vector : set.all()) all.push_back(vector.operands);
    return all;
  };
  EXPECT_EQ(operands(again), operands(set_));
  EXPECT_NE(operands(other), operands(set_));
  EXPECT_EQ(rtl::vector_summary("unit", again, results), rtl::vector_summary("unit", set_, results));
}

TEST_P(DesignVectors, FewAreDrawnToo) {
  EXPECT_EQ(design_vectors(design_, format_, 1, 5).size(), 1U);
  EXPECT_EQ(design_vectors(design_, format_, 7, 5).size(), 7U);
}

INSTANTIATE_TEST_SUITE_P(Designs, DesignVectors,
                         testing::Values("int_slabs", "fp_plucker", "int_major", "int_major_pair"));

TEST(VectorSummary, NamesTheLinesOfEveryGroup) {
  const std::vector<hls::Result> hit{{"hit", hls::Meaning::hit, 0, 1, false}};
  const rtl::VectorSet set{3, {{"corners", {{{1}, {1}}, {{2}, {0}}}}, {"none", {}}, {"edge", {{{3}, {1}}}}}};
  EXPECT_EQ(rtl::vector_summary("slab 8/8", set, hit),
            "// slab 8/8: 3 vectors of seed 3, of which 2 hit a box.\n"
            "// A line is a vector: the operands, the first port in the high bits, then the results.\n"
            "// from                     first    last    hits\n"
            "// corners                      0       1       1\n"
            "// edge                         2       2       1\n");
}

}  // namespace
}  // namespace hitpipe::sim::design_vectors_test
