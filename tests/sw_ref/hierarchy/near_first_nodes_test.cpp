// Nodes that hold the boxes of their children, wide nodes and compact pairs: decoded boxes contain the plain
// boxes, every triangle is in one leaf, pointers in a node's own bits lead where the store says, and the
// leaves are small.
#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "rays/tree/small_leaves.hpp"
#include "rays/tree/wide_nodes.hpp"
#include "sw_ref/hierarchy/compact_pairs.hpp"
#include "tests/rays/tree/hierarchies.hpp"

namespace hitpipe::ref::near_first_nodes_test {
namespace {

using hierarchies::built;
using hierarchies::describe;
using hierarchies::one_leaf;
using hierarchies::Random;
using hierarchies::refusal_of;
using hierarchies::Sample;
using hierarchies::samples;
using hierarchies::seed;

template <class Store>
class NearFirstNodes : public testing::Test {};

using Stores =
    testing::Types<WideNodes<WideNode<4>>, WideNodes<WideNode<8>>, WideNodes<WideFloatNode<4>>,
                   WideNodes<WideFloatNode<8>>, CompactPairs<8>, CompactPairs<13>, CompactPairs<18>>;
TYPED_TEST_SUITE(NearFirstNodes, Stores);

/// The nodes of the binary hierarchy from the root to the leaf of each triangle, the root first.
std::vector<std::vector<std::uint32_t>> paths_of(const Bvh& bvh) {
  std::vector<std::vector<std::uint32_t>> paths(bvh.order.size());
  std::vector<std::vector<std::uint32_t>> pending{{0}};
  while (!pending.empty()) {
    const std::vector<std::uint32_t> path = pending.back();
    pending.pop_back();
    const BvhNode& node = bvh.nodes[path.back()];
    if (node.is_leaf()) {
      for (std::int32_t i = 0; i < node.count; ++i)
        paths[bvh.order[node.first + static_cast<std::uint32_t>(i)]] = path;
      continue;
    }
    for (std::uint32_t which = 0; which < 2; ++which) {
      pending.push_back(path);
      pending.back().push_back(node.first + which);
    }
  }
  return paths;
}

/// A node of the store and the decoded boxes around it.
struct Visited {
  BoxedChild node;
  std::vector<Aabb> boxes;
};

/// visit(leaf) with the boxes from below the root to the leaf. Returns how many nodes were loaded.
template <class Store, class Visit>
std::size_t visit_leaves(const Store& store, const Visit& visit) {
  std::vector<bool> seen(store.size());
  std::vector<Visited> pending{{store.root(), {}}};
  while (!pending.empty()) {
    const Visited at = pending.back();
    pending.pop_back();
    if (!at.node.is_branch()) {
      visit(at);
      continue;
    }
    EXPECT_FALSE(seen[at.node.first]) << at.node.first;
    seen[at.node.first] = true;
    std::array<BoxedChild, Store::width> children;
    const unsigned count = store.children(at.node, children);
    EXPECT_GE(count, store.size() == 1 ? 1U : 2U);
    for (unsigned i = 0; i < count; ++i) {
      pending.push_back({children[i], at.boxes});
      pending.back().boxes.push_back(children[i].box);
    }
  }
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
}

/// Each decoded box on the way to a triangle contains one of the plain boxes on the way to it, and they go
/// down in the same order to the same leaf.
TYPED_TEST(NearFirstNodes, DecodedBoxesContainThePlainBoxesOnEachPath) {
  for (const Sample& sample : samples()) {
    const Bvh bvh = built(sample);
    const auto paths = paths_of(bvh);
    const TypeParam store(bvh);
    std::vector<int> found(bvh.order.size());
    int outside = 0;
    const std::size_t loaded = visit_leaves(store, [&](const Visited& leaf) {
      ASSERT_GE(leaf.node.count, 1);
      ASSERT_LE(leaf.node.count, TypeParam::width == 2 ? 14 : 3);
      for (std::int32_t i = 0; i < leaf.node.count; ++i) {
        const std::uint32_t triangle = store.order()[leaf.node.first + static_cast<std::uint32_t>(i)];
        ++found[triangle];
        const Aabb& plain = bvh.nodes[paths[triangle].back()].box;
        for (const Aabb& box : leaf.boxes) {
          if (encloses(box, plain)) continue;
          ++outside;
          ADD_FAILURE() << sample.name << ": " << describe(plain) << " in " << describe(box);
        }
      }
    });
    EXPECT_EQ(outside, 0);
    EXPECT_EQ(loaded, store.size()) << sample.name;
    EXPECT_EQ(std::count(found.begin(), found.end(), 1), static_cast<std::ptrdiff_t>(found.size()))
        << sample.name;
  }
}

/// A root that is a leaf, and one with a large leaf, whose halves keep its box.
TYPED_TEST(NearFirstNodes, LargeLeavesAreHalved) {
  for (const int triangles : {1, 2, 3, 4, 14, 15, 100}) {
    Bvh bvh = one_leaf(triangles);
    for (int i = 0; i < triangles; ++i) bvh.order.push_back(static_cast<std::uint32_t>(triangles - 1 - i));
    const TypeParam store(bvh);
    std::vector<std::uint32_t> found;
    visit_leaves(store, [&](const Visited& leaf) {
      EXPECT_TRUE(encloses(leaf.boxes.back(), bvh.nodes[0].box));
      for (std::int32_t i = 0; i < leaf.node.count; ++i)
        found.push_back(store.order()[leaf.node.first + static_cast<std::uint32_t>(i)]);
    });
    std::sort(found.begin(), found.end());
    ASSERT_EQ(found.size(), static_cast<std::size_t>(triangles));
    for (std::uint32_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], i);
  }
}

TYPED_TEST(NearFirstNodes, BoxOutsideItsParentIsRejected) {
  Bvh bvh = one_leaf(-1);
  bvh.order = {0, 1};
  bvh.nodes[0].first = 1;
  bvh.nodes.resize(3, one_leaf(1).nodes[0]);
  bvh.nodes[2].first = 1;
  EXPECT_EQ(refusal_of<TypeParam>(bvh), "accepted");
  bvh.nodes[2].box.min.z = -0.75F;
  EXPECT_EQ(refusal_of<TypeParam>(bvh), std::string(TypeParam::width == 2 ? "compact pairs" : "wide nodes") +
                                            ": the box of node 2 leaves its parent's");
}

TEST(SmallLeaves, HalvesKeepBoxAndOrder) {
  const Bvh split = small_leaves(one_leaf(5), 2);
  std::vector<std::uint32_t> firsts;
  std::vector<std::int32_t> counts;
  for (const BvhNode& node : split.nodes) {
    EXPECT_EQ(node.box.min, one_leaf(5).nodes[0].box.min);
    if (!node.is_leaf()) continue;
    firsts.push_back(node.first);
    counts.push_back(node.count);
  }
  EXPECT_EQ(firsts, (std::vector<std::uint32_t>{0, 2, 3}));
  EXPECT_EQ(counts, (std::vector<std::int32_t>{2, 1, 2}));
}

TEST(JoinedLeaves, HoldWhatTheirBranchesHeld) {
  for (const Sample& sample : samples()) {
    const Bvh bvh = built(sample);
    const Bvh joined = joined_leaves(bvh, 4);
    EXPECT_EQ(joined.order, bvh.order);
    std::vector<std::uint32_t> pending{0};
    std::uint32_t next = 0;  // leaves follow each other in the order
    while (!pending.empty()) {
      const BvhNode& node = joined.nodes[pending.back()];
      const BvhNode& before = bvh.nodes[pending.back()];
      pending.pop_back();
      EXPECT_EQ(node.box.min, before.box.min);
      EXPECT_EQ(node.box.max, before.box.max);
      if (node.is_leaf()) {
        EXPECT_TRUE(before.is_leaf() || node.count <= 4);
        EXPECT_EQ(node.first, next);
        next += static_cast<std::uint32_t>(node.count);
        continue;
      }
      const BvhNode& left = joined.nodes[node.first];
      const BvhNode& right = joined.nodes[node.first + 1];
      EXPECT_FALSE(left.is_leaf() && right.is_leaf() && left.count + right.count <= 4);
      pending.push_back(node.first + 1);
      pending.push_back(node.first);
    }
    EXPECT_EQ(next, bvh.order.size());
  }
}

/// From tiny to whole widths, the grid is the finest power of two that reaches.
TEST(LocalGrid, ReachesFromMinToMaxOfAnyBox) {
  Random random(seed + 2);
  for (int i = 0; i < 100'000; ++i) {
    const float a = random.coin() ? random.signed_unit() : random.of_exponent(-149, -1);
    float b = random.coin() ? random.signed_unit() : random.of_exponent(-149, -1);
    if (random.below(4) == 0) b = std::nextafter(a, b);
    if (random.below(16) == 0) b = a;
    const Aabb box{glm::vec3(std::min(a, b)), glm::vec3(std::max(a, b))};
    const LocalGrid grid(box);
    ASSERT_EQ(grid.decoded(0, 0), box.min.x) << describe(box);
    ASSERT_GE(grid.decoded(0, LocalGrid::top), box.max.x) << describe(box);
    ASSERT_TRUE(grid.exponents()[0] == 1 || box.min.x + LocalGrid::top * (0.5F * grid.step(0)) < box.max.x)
        << describe(box);
  }
}

/// What the comments of the formats say of their bits.
TEST(WideNode, KindsAndBranchesAreThoseOfCwbvh) {
  const Aabb box{glm::vec3(0.0F), glm::vec3(0.5F)};
  const std::vector<BoxedChild> children{
      {box, 2, 0}, {box, BoxedChild::branch, 0}, {box, 3, 0}, {box, BoxedChild::branch, 0}};
  const WideNode<8> node(box, children, {100, 200});
  EXPECT_EQ(node.branches, 0b1010U);
  EXPECT_EQ(node.kinds[0], 0b011'00000U);
  EXPECT_EQ(node.kinds[1], 0b001'11001U);
  EXPECT_EQ(node.kinds[2], 0b111'00010U);
  EXPECT_EQ(node.kinds[3], 0b001'11011U);
  EXPECT_EQ(node.kinds[4], 0U);
  ASSERT_EQ(node.children(), 4U);
  EXPECT_EQ(node.child(1).first, 100U);
  EXPECT_EQ(node.child(2).first, 202U);
  EXPECT_EQ(node.child(2).count, 3);
  EXPECT_EQ(node.child(3).first, 101U);
}

/// Records and the triangles before them, so that one pointer is enough for both children.
TYPED_TEST(NearFirstNodes, OnePointerIsEnoughForBothChildrenOfAPair) {
  if constexpr (TypeParam::width == 2) {
    const TypeParam store(built(samples().front()));
    const auto before = store.triangles_before();
    ASSERT_EQ(before.size(), store.size());
    EXPECT_TRUE(std::is_sorted(before.begin(), before.end()));
    std::vector<BoxedChild> pending{store.root()};
    while (!pending.empty()) {
      const BoxedChild node = pending.back();
      pending.pop_back();
      std::array<BoxedChild, 2> children;
      ASSERT_EQ(store.children(node, children), 2U);
      const bool branches[] = {children[0].is_branch(), children[1].is_branch()};
      if (branches[0] && branches[1]) {
        EXPECT_EQ(children[1].first, children[0].first + 1);
        EXPECT_EQ(before[children[1].first], before[children[0].first]);
      } else if (branches[0]) {
        EXPECT_EQ(before[children[0].first], children[1].first);
      } else if (branches[1]) {
        EXPECT_EQ(before[children[1].first],
                  children[0].first + static_cast<std::uint32_t>(children[0].count));
      } else {
        EXPECT_EQ(children[1].first, children[0].first + static_cast<std::uint32_t>(children[0].count));
      }
      for (const BoxedChild& child : children)
        if (child.is_branch()) pending.push_back(child);
    }
  }
}

}  // namespace
}  // namespace hitpipe::ref::near_first_nodes_test
