// Walks through random trees with stacks of 0 places and more: each finds what a search of all leaves finds.
#include "sw_ref/trace/trail_walk.hpp"

#include <map>

#include <gtest/gtest.h>

#include "tests/sw_ref/trace/random_tree.hpp"

namespace hitpipe::ref::trail_walk_test {
namespace {

struct Walked {
  TreeHit best;
  TrailWalk::Counts counts;
};

Walked walk(const RandomTree& tree, std::int64_t length, int places, bool any = false) {
  Walked made{{length, no_triangle}, {}};
  TrailWalk walk({PairChild::branch, 0}, length, places);
  while (!walk.done()) {
    const RandomTree::Box& box = tree.boxes[walk.at().first];
    if (walk.at_leaf()) {
      for (const TreeHit& hit : box.hits) made.best = std::min(made.best, hit);
      if (any && made.best.second != no_triangle) break;
      walk.leaf_done(made.best.first);
      continue;
    }
    PairAnswer answer;
    std::array<PairChild, 2> children;
    std::array<std::int64_t, 2> near{};
    for (std::size_t i = 0; i < 2; ++i) {
      if (box.children[i] < 0) continue;
      const RandomTree::Box& child = tree.boxes[static_cast<std::size_t>(box.children[i])];
      children[i] = tree.as_child(box.children[i]);
      near[i] = child.near;
      const std::int64_t far = std::min(child.far, walk.interval().far);
      answer.hit[i] = child.near <= far;
      answer.interval[i] = {child.near, far};
    }
    answer.second_first = near[1] < near[0] || (near[1] == near[0] && box.ties_second);
    walk.answer(answer, children);
  }
  EXPECT_FALSE(walk.too_deep());
  made.counts = walk.counts();
  return made;
}

TEST(TrailWalk, FindsWhatASearchFinds) {
  TreeGrower grower(1);
  std::map<int, TrailWalk::Counts> sums;
  for (int i = 0; i < 20'000; ++i) {
    const RandomTree tree = grower.tree();
    const std::int64_t length = i % 2 == 0 ? grower.within(0, 1'000'000) : 10'000'000;
    const TreeHit expected = search(tree, length);
    for (const int places : {0, 1, 2, 3, 4, 8, 60}) {
      const Walked found = walk(tree, length, places);
      ASSERT_EQ(found.best, expected) << "tree " << i << ", " << places << " places";
      ASSERT_EQ(walk(tree, length, places, true).best.second == no_triangle, expected.second == no_triangle);
      sums[places].records += found.counts.records;
      sums[places].restarts += found.counts.restarts;
      sums[places].leaves += found.counts.leaves;
    }
  }
  // A whole stack never restarts, and no walk tests fewer records.
  EXPECT_EQ(sums[60].restarts, 0U);
  EXPECT_GT(sums[0].restarts, sums[1].restarts);
  EXPECT_GT(sums[1].restarts, sums[4].restarts);
  EXPECT_GT(sums[4].restarts, 0U);
  for (const auto& [places, sum] : sums) {
    EXPECT_GE(sum.records, sums[60].records) << places;
    EXPECT_EQ(sum.leaves, sums[60].leaves) << places << ": no leaf is tested twice";
  }
}

TEST(TrailWalk, EndsInAHierarchyThatIsTooDeep) {
  TrailWalk walk({PairChild::branch, 0}, 100, 2);
  int records = 0;
  while (!walk.done()) {
    ++records;
    walk.answer({.hit = {true, false}, .interval = {{{0, 100}, {}}}}, {{{PairChild::branch, 0}, {}}});
  }
  EXPECT_TRUE(walk.too_deep());
  EXPECT_EQ(records, TrailWalk::levels);
}

}  // namespace
}  // namespace hitpipe::ref::trail_walk_test
