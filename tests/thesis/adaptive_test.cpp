// Section 8.2's adaptive precision, and the rows of Table 7.2.

#include <gtest/gtest.h>

#include "thesis/proposals.hpp"

namespace hitpipe::thesis::adaptive_test {
namespace {

TEST(AdaptivePrecision, AsksLessOftenWithMoreBitsAndWithAThirdAnswer) {
  ExperimentOptions options;
  options.only = {"spheres"};
  options.width = 24;
  options.height = 16;
  const ResultTable table = adaptive_precision("adaptive", options);
  ASSERT_EQ(table.rows.size(), 6U);
  const auto& three = table.rows[0].ours;
  const auto& two = table.rows[1].ours;
  for (std::size_t i = 0; i < three.size(); ++i) {
    EXPECT_LT(*three[i], *two[i]);
    // A second unit of n1 bits costs as much as the first.
    const double first = *table.rows[2].ours[i] - *three[i];
    EXPECT_NEAR(*table.rows[3].ours[i] - *three[i], 2 * first, 1e-9);
  }
  for (std::size_t i = 1; i < three.size(); ++i) EXPECT_LT(*three[i], *three[i - 1]);
  EXPECT_GT(*three[0], 5.0) << "8 bits";
  EXPECT_LT(*three[4], 5.0) << "16 bits";
}

TEST(Table72, RowsAreThePrintedOnes) {
  const ResultTable table = find_experiment("7.2", experiments()).run("7.2", {});
  ASSERT_EQ(table.rows.size(), 6U);
  for (const ResultRow& row : table.rows)
    for (std::size_t i = 1; i < table.columns.size(); ++i)
      EXPECT_NEAR(*row.ours[i], *row.printed[i], table.columns[i].half_unit * 1.0001) << row.labels[0];
}

}  // namespace
}  // namespace hitpipe::thesis::adaptive_test
