// Random trees of boxes that one ray meets, for walks through them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "rays/world/pair_nodes.hpp"

namespace hitpipe::ref {

using TreeHit = std::pair<std::int64_t, int>;  ///< T, number

/// Boxes as intervals of one ray. A leaf's hits lie in its interval, and a child's interval in its parent's.
struct RandomTree {
  struct Box {
    std::int64_t near, far;
    std::array<int, 2> children{-1, -1};  ///< places in `boxes`; -1 in a leaf
    std::vector<TreeHit> hits{};
    bool ties_second = false;  ///< children that are entered at the same distance: the second is first
  };
  std::vector<Box> boxes;

  [[nodiscard]] PairChild as_child(int place) const {
    const Box& box = boxes[static_cast<std::size_t>(place)];
    const bool leaf = box.children[0] < 0;
    return {leaf ? 1 : PairChild::branch, static_cast<std::uint32_t>(place)};
  }
};

class TreeGrower {
 public:
  explicit TreeGrower(unsigned seed) : random_(seed) {}

  RandomTree tree() {
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
  RandomTree tree_;
  int number_ = 0;
};

inline constexpr int no_triangle = 1 << 30;

/// The nearest hit, by looking everywhere.
inline TreeHit search(const RandomTree& tree, std::int64_t length) {
  TreeHit best{length, no_triangle};
  for (const RandomTree::Box& box : tree.boxes)
    for (const TreeHit& hit : box.hits) best = std::min(best, hit);
  return best;
}

}  // namespace hitpipe::ref
