// The statistics of a hierarchy, computed by hand, and of Appendix B's sweep.
#include "sw_ref/hierarchy/statistics.hpp"

#include <gtest/gtest.h>

#include "tests/rays/tree/meshes.hpp"

namespace hitpipe::ref::statistics_test {
namespace {

TEST(Statistics, AreThoseOfAHierarchyWorkedOutByHand) {
  // Half surfaces: root 4 x 1 x 1 is 9; child 0, 3 x 1 x 1, is 7; child 1, 2 x 1 x 1, is 5; they share
  // 1 x 1 x 1, 3.
  const Bvh bvh{.nodes = {{{{0, 0, 0}, {4, 1, 1}}, -1, 1},
                          {{{0, 0, 0}, {3, 1, 1}}, 2, 0},
                          {{{2, 0, 0}, {4, 1, 1}}, 5, 2}},
                .order = {0, 1, 2, 3, 4, 5, 6},
                .depth = 2};
  const BvhStatistics s = statistics(bvh);
  EXPECT_EQ(s.nodes, 3U);
  EXPECT_EQ(s.leaves, 2U);
  EXPECT_EQ(s.triangles, 7U);
  EXPECT_EQ(s.depth, 2);
  EXPECT_EQ(s.leaves_of, (std::vector<std::size_t>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(s.most_in_leaf(), 5);
  EXPECT_DOUBLE_EQ(s.mean_in_leaf(), 3.5);
  EXPECT_DOUBLE_EQ(s.sah_cost, 1.0 + (7.0 * 2 + 5.0 * 5) / 9.0);
  EXPECT_DOUBLE_EQ(s.child_overlap, 3.0 / 9.0);
  EXPECT_EQ(s.node_bytes, 96U);
  EXPECT_EQ(s.order_bytes, 28U);
}

TEST(Statistics, ChildrenApartDoNotOverlap) {
  const Bvh bvh = build_bvh(triangles_at({{-0.5F, 0, 0}, {0.5F, 0, 0}}), {.max_triangles = 1});
  EXPECT_EQ(statistics(bvh).child_overlap, 0.0);
  const Bvh same = build_bvh(coincident(2), {.max_triangles = 1});
  EXPECT_EQ(statistics(same).child_overlap, 1.0);
  EXPECT_DOUBLE_EQ(statistics(same).sah_cost, 3.0);
}

TEST(Statistics, BoxWithoutSurfaceCostsNothing) {
  const Bvh bvh = build_bvh(triangles_at({{0.5F, 0.5F, 0.5F}}, 0.0F), {.padding = 0.0F});
  EXPECT_EQ(statistics(bvh).sah_cost, 0.0);
  EXPECT_EQ(statistics(bvh).mean_in_leaf(), 1.0);
}

TEST(Sweep, BuildsEachSizeOfAppendixBOnce) {
  const Mesh mesh = soup(3'000, 0.05F);
  std::vector<int> sizes;
  std::vector<std::size_t> nodes;
  sweep_max_triangles(mesh, {.max_depth = 40}, [&](const SweepStep& step) {
    sizes.push_back(step.max_triangles);
    nodes.push_back(step.bvh.nodes.size());
    EXPECT_GE(step.build_seconds, 0.0);
    EXPECT_LE(statistics(step.bvh).most_in_leaf(), step.max_triangles);
  });
  EXPECT_EQ(sizes, std::vector<int>(appendix_b_sizes.begin(), appendix_b_sizes.end()));
  EXPECT_EQ(nodes.front(), 5'999U);  // one triangle a leaf
  for (std::size_t i = 1; i < nodes.size(); ++i) EXPECT_LE(nodes[i], nodes[i - 1]) << sizes[i];
  EXPECT_LT(nodes.back(), 40U);
}

}  // namespace
}  // namespace hitpipe::ref::statistics_test
