// Walks through random trees with stacks of 0 places and more: each finds what a search of all leaves finds.
#include "sw_ref/trace/trail_walk.hpp"

#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace hitpipe::ref::trail_walk_test {
namespace {

using Hit = std::pair<std::int64_t, int>;  // T, number

/// Boxes as intervals of one ray. A leaf's hits lie in its interval, and a child's interval in its parent's.
struct Tree {
  struct Box {
    std::int64_t near, far;
    std::array<int, 2> children{-1, -1};  ///< places in `boxes`; -1 in a leaf
    std::vector<Hit> hits{};
    bool ties_second = false;  ///< children that are entered at the same distance: the second is first
  };
  std::vector<Box> boxes;

  [[nodiscard]] PairChild as_child(int place) const {
    const Box& box = boxes[static_cast<std::size_t>(place)];
    const bool leaf = box.children[0] < 0;
    return {leaf ? 1 : PairChild::branch, static_cast<std::uint32_t>(place)};
  }
};

class Grower {
 public:
  explicit Grower(unsigned seed) : random_(seed) {}

  Tree tree() {
    tree_ = {};
    number_ = 0;
    const std::int64_t lengths[] = {20, 300, 1'000'000};
    const std::int64_t far = lengths[random_() % 3];
    // The root's own record has the root as child 0 alone.
    tree_.boxes.push_back({0, far});
    const int root = grow(static_cast<int>(random_() % 10), 0, far);
    tree_.boxes[0].children[0] = root;
    return tree_;
  }
  std::int64_t within(std::int64_t low, std::int64_t high) {
    return low + static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(high - low + 1));
  }

 private:
  int grow(int depth, std::int64_t near, std::int64_t far) {
    const int place = static_cast<int>(tree_.boxes.size());
    tree_.boxes.push_back({near, far});
    if (depth == 0 || random_() % 12 == 0 || far - near < 2) {
      for (unsigned i = random_() % 4; i-- > 0;)
        tree_.boxes.back().hits.push_back({within(near, far), number_++});
      return place;
    }
    std::array<int, 2> children;
    for (int& child : children) {
      const std::int64_t a = random_() % 3 == 0 ? near : within(near, (near + far) / 2);
      const std::int64_t b = random_() % 3 == 0 ? far : within((a + far) / 2, far);
      if (random_() % 5 == 0) {
        child = static_cast<int>(tree_.boxes.size());
        tree_.boxes.push_back({a, a - 1});  // the ray misses it
      } else {
        child = grow(depth - 1, a, b);
      }
    }
    tree_.boxes[static_cast<std::size_t>(place)].children = children;
    tree_.boxes[static_cast<std::size_t>(place)].ties_second = random_() % 2 == 0;
    return place;
  }

  std::mt19937_64 random_;
  Tree tree_;
  int number_ = 0;
};

constexpr int none = 1 << 30;

Hit search(const Tree& tree, std::int64_t length) {
  Hit best{length, none};
  for (const Tree::Box& box : tree.boxes)
    for (const Hit& hit : box.hits) best = std::min(best, hit);
  return best;
}

struct Walked {
  Hit best;
  TrailWalk::Counts counts;
};

Walked walk(const Tree& tree, std::int64_t length, int places, bool any = false) {
  Walked made{{length, none}, {}};
  TrailWalk walk({PairChild::branch, 0}, length, places);
  while (!walk.done()) {
    const Tree::Box& box = tree.boxes[walk.at().first];
    if (walk.at_leaf()) {
      for (const Hit& hit : box.hits) made.best = std::min(made.best, hit);
      if (any && made.best.second != none) break;
      walk.leaf_done(made.best.first);
      continue;
    }
    PairAnswer answer;
    std::array<PairChild, 2> children;
    std::array<std::int64_t, 2> near{};
    for (std::size_t i = 0; i < 2; ++i) {
      if (box.children[i] < 0) continue;
      const Tree::Box& child = tree.boxes[static_cast<std::size_t>(box.children[i])];
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
  Grower grower(1);
  std::map<int, TrailWalk::Counts> sums;
  for (int i = 0; i < 20'000; ++i) {
    const Tree tree = grower.tree();
    const std::int64_t length = i % 2 == 0 ? grower.within(0, 1'000'000) : 10'000'000;
    const Hit expected = search(tree, length);
    for (const int places : {0, 1, 2, 3, 4, 8, 60}) {
      const Walked found = walk(tree, length, places);
      ASSERT_EQ(found.best, expected) << "tree " << i << ", " << places << " places";
      ASSERT_EQ(walk(tree, length, places, true).best.second == none, expected.second == none);
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
