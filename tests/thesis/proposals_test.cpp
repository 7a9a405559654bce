// What section 8.2 proposes: k-d planes of few bits and grids by side relations.
#include "thesis/proposals.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hitpipe::thesis::proposals_test {
namespace {

ExperimentOptions spheres() {
  ExperimentOptions options;
  options.only = {"spheres"};
  options.width = 24;
  options.height = 16;
  return options;
}

TEST(KdPlanes, OfFewBitsFindTheSameTrianglesWithMoreWork) {
  ExperimentOptions options = spheres();
  options.only = {"waves"};
  options.triangles = 10'000;
  options.width = options.height = 64;
  const ResultTable table = kd_planes("kd", options);
  ASSERT_EQ(table.rows.size(), 3U);
  EXPECT_THAT(table.notes.front(), testing::HasSubstr(" 0 answers differ"));
  EXPECT_GT(*table.rows[0].ours[4], 100.0) << "nodes at 8 bits: a moved plane cuts triangles";
  const auto& steps = table.rows[1].ours;
  EXPECT_GT(*steps[1], *steps[4]) << "2 and 8 bits";
  EXPECT_GT(*steps[4], 0.0);
  EXPECT_GT(*table.rows[2].ours[4], 0.0);
}

TEST(GridCells, MoreBitsLeaveFewerRaysInOtherCells) {
  const ResultTable table = grid_cells("grid", spheres());
  ASSERT_EQ(table.rows.size(), 1U);
  const auto& figures = table.rows[0].ours;
  EXPECT_GT(*figures[0], 10.0) << "steps";
  EXPECT_LT(*figures[0], 192.0);
  EXPECT_GT(*figures[2], *figures[4]) << "16 and 24 bits";
  EXPECT_LT(*figures[1], 5.0) << "binary32 distances";
  EXPECT_LE(table.rows[0].intervals[2]->low, *figures[2]);
}

TEST(Proposals, UnknownSceneRejected) {
  ExperimentOptions options = spheres();
  options.only = {"teapot"};
  EXPECT_THROW((void)kd_planes("kd", options), std::runtime_error);
}

}  // namespace
}  // namespace hitpipe::thesis::proposals_test
