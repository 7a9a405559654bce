// Hierarchical nodes against the plain nodes: decoded boxes contain the plain boxes, nodes have the sizes of
// Table 5.1, and a hierarchy that cannot be encoded is refused. Nodes in binary64 are exact copies.
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "rays/tree/relative_box.hpp"
#include "sw_ref/hierarchy/double_nodes.hpp"
#include "sw_ref/hierarchy/hierarchical_nodes.hpp"
#include "tests/rays/tree/hierarchies.hpp"

namespace hitpipe::ref::encode_test {
namespace {

using hierarchies::built;
using hierarchies::describe;
using hierarchies::expect_same_tree;
using hierarchies::one_leaf;
using hierarchies::Random;
using hierarchies::refusal_of;
using hierarchies::Sample;
using hierarchies::samples;
using hierarchies::seed;
using hierarchies::spheres;
using hierarchies::walk;

bool contains(const Aabb& outer, const Aabb& inner) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) &&
         glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

double surface(const Aabb& box) {
  const glm::dvec3 side = glm::dvec3(box.max) - glm::dvec3(box.min);
  return side.x * side.y + side.y * side.z + side.z * side.x;
}

template <class Store>
class HierarchicalBits : public testing::Test {};

template <int bits_, bool lut_>
struct Code {
  static constexpr int bits = bits_;
  using Store = HierarchicalNodes<bits_, lut_>;
};
using Codes = testing::Types<Code<4, false>, Code<4, true>, Code<8, false>, Code<8, true>, Code<12, false>,
                             Code<16, false>>;
TYPED_TEST_SUITE(HierarchicalBits, Codes);

TYPED_TEST(HierarchicalBits, DecodedBoxesContainThePlainBoxes) {
  using Store = typename TypeParam::Store;
  for (const Sample& sample : samples()) {
    const Bvh bvh = built(sample);
    const Store store(bvh);
    double growth = 0;
    int with_surface = 0;
    int outside = 0;
    walk<Store>(store, [&](const typename Store::Node& node) {
      const Aabb& plain = bvh.nodes[store.index(node)].box;
      if (!contains(store.box(node), plain)) {
        ++outside;
        ADD_FAILURE() << sample.name << ": node " << store.index(node) << ", " << describe(plain) << " in "
                      << describe(store.box(node));
      }
      if (surface(plain) > 0) {
        growth += surface(store.box(node)) / surface(plain);
        ++with_surface;
      }
    });
    EXPECT_EQ(outside, 0);
    EXPECT_EQ(expect_same_tree(store, bvh), bvh.nodes.size());
    std::printf("seed %llu, %s: %zu nodes, %d levels, surface %.6f of the plain boxes'\n",
                static_cast<unsigned long long>(seed), sample.name, bvh.nodes.size(), bvh.depth,
                growth / with_surface);
    if (sample.make == spheres) {
      // A side grows by at most two steps of the parent. With few bits that shows, with many it does not.
      const double most = 1 + 40 * std::ldexp(1.0, -TypeParam::bits);
      EXPECT_LT(growth / with_surface, most);
      EXPECT_GT(growth / with_surface, 1 + std::ldexp(1.0, -TypeParam::bits));
    }
  }
}

TYPED_TEST(HierarchicalBits, CodesReachFromMinToMaxOfAnyParent) {
  constexpr int parents = 100'000;
  Random random(seed + 1);
  int narrow = 0;
  for (int i = 0; i < parents; ++i) {
    const float a = random.coin() ? random.signed_unit() : random.of_exponent(-149, -1);
    float b = random.coin() ? random.signed_unit() : random.of_exponent(-149, -1);
    if (random.below(4) == 0) b = std::nextafter(a, b);
    if (random.below(16) == 0) b = a;
    const Aabb parent{glm::vec3(std::min(a, b)), glm::vec3(std::max(a, b))};
    const RelativeFrame<TypeParam::bits> frame(parent);
    ASSERT_EQ(frame.decoded(1, 0), parent.min.y) << describe(parent);
    ASSERT_GE(frame.decoded(1, static_cast<float>(top_code<TypeParam::bits>)), parent.max.y)
        << describe(parent);
    narrow += parent.max.y - parent.min.y < 1e-6F ? 1 : 0;
  }
  std::printf("seed %llu: %d parents, %d narrower than 1e-6\n", static_cast<unsigned long long>(seed + 1),
              parents, narrow);
  EXPECT_GT(narrow, parents / 8);
}

TEST(Hierarchical, TablesDecodeTheSameBoxes) {
  const Bvh bvh = built(samples().front());
  const auto expect_equal = [&](const auto& plain, const auto& table) {
    std::vector<Aabb> boxes(bvh.nodes.size());
    walk(plain, std::function([&](const typename std::decay_t<decltype(plain)>::Node& node) {
           boxes[node.index] = node.box;
         }));
    walk(table, std::function([&](const typename std::decay_t<decltype(table)>::Node& node) {
           EXPECT_TRUE(boxes[node.index].min == node.box.min && boxes[node.index].max == node.box.max)
               << node.index;
         }));
  };
  expect_equal(HierarchicalNodes<4, false>(bvh), HierarchicalNodes<4, true>(bvh));
  expect_equal(HierarchicalNodes<8, false>(bvh), HierarchicalNodes<8, true>(bvh));
}

/// Levels that all have the same box, as wide as a padded box can be. Each takes the top code of the level
/// above.
TYPED_TEST(HierarchicalBits, ChainOfEqualBoxesHardlyGrows) {
  using Store = typename TypeParam::Store;
  const Aabb box{glm::vec3(-1 - 5e-7F), glm::vec3(1 + 5e-7F)};
  Bvh bvh;
  bvh.nodes.push_back({box, 1, 0});
  for (int level = 1; level < BuildOptions::deepest; ++level) {
    BvhNode& parent = bvh.nodes[bvh.nodes.size() - 1];
    parent.count = -1;
    parent.first = static_cast<std::uint32_t>(bvh.nodes.size());
    bvh.nodes.insert(bvh.nodes.end(), 2, {box, 1, 0});
  }
  int visited = 0;
  walk<Store>(Store(bvh), [&](const typename Store::Node& node) {
    ++visited;
    EXPECT_TRUE(contains(node.box, box)) << describe(node.box);
    EXPECT_TRUE(contains({glm::vec3(-1 - 0x1p-13F), glm::vec3(1 + 0x1p-13F)}, node.box))
        << describe(node.box);
  });
  EXPECT_EQ(visited, 119);
}

TEST(Hierarchical, NodesHaveTheSizesOfTable5_1) {
  EXPECT_EQ((HierarchicalNodes<4, true>::bytes_per_node), 8U);
  EXPECT_EQ(HierarchicalNodes<8>::bytes_per_node, 12U);
  EXPECT_EQ(HierarchicalNodes<12>::bytes_per_node, 16U);
  EXPECT_EQ(HierarchicalNodes<16>::bytes_per_node, 20U);
  EXPECT_EQ(DoubleNodes::bytes_per_node, 56U);
}

TEST(Hierarchical, LeafOfMoreTrianglesThanTheCountHoldsIsRejected) {
  EXPECT_EQ((refusal_of<HierarchicalNodes<4, true>>(one_leaf(127))), "accepted");
  EXPECT_EQ((refusal_of<HierarchicalNodes<4, true>>(one_leaf(128))),
            "4-bit nodes: a leaf of 128 triangles; at most 127 fit, build with fewer per leaf");
  EXPECT_EQ(refusal_of<HierarchicalNodes<8>>(one_leaf(32767)), "accepted");
  EXPECT_EQ(refusal_of<HierarchicalNodes<8>>(one_leaf(32768)),
            "8-bit nodes: a leaf of 32768 triangles; at most 32767 fit, build with fewer per leaf");
  EXPECT_EQ(refusal_of<HierarchicalNodes<12>>(one_leaf(32768)),
            "12-bit nodes: a leaf of 32768 triangles; at most 32767 fit, build with fewer per leaf");
  EXPECT_EQ(refusal_of<HierarchicalNodes<16>>(one_leaf(std::numeric_limits<std::int32_t>::max())),
            "accepted");
}

TEST(Hierarchical, BoxOutsideItsParentIsRejected) {
  Bvh bvh = one_leaf(1);
  bvh.nodes[0].box.max.y = 1.0F + 0x1p-20F;
  EXPECT_EQ(refusal_of<HierarchicalNodes<8>>(bvh), "accepted");
  bvh.nodes[0].box.max.y = 1.0F + 0x1p-19F;
  EXPECT_EQ(refusal_of<HierarchicalNodes<8>>(bvh),
            "8-bit nodes: the root's box leaves the cube of +-1.000001");
  bvh = one_leaf(-1);
  bvh.nodes[0].first = 1;
  bvh.nodes.resize(3, one_leaf(1).nodes[0]);
  EXPECT_EQ(refusal_of<HierarchicalNodes<8>>(bvh), "accepted");
  bvh.nodes[2].box.min.z = -0.75F;
  EXPECT_EQ(refusal_of<HierarchicalNodes<8>>(bvh), "8-bit nodes: the box of node 2 leaves its parent's");
}

TEST(DoubleNodes, BoxesAreExactCopies) {
  const Bvh bvh = built(samples().front());
  const DoubleNodes store(bvh);
  EXPECT_EQ(expect_same_tree(store, bvh), bvh.nodes.size());
  for (std::uint32_t i = 0; i < bvh.nodes.size(); ++i) {
    EXPECT_TRUE(store.box(i).min == glm::dvec3(bvh.nodes[i].box.min) &&
                store.box(i).max == glm::dvec3(bvh.nodes[i].box.max))
        << i;
  }
}

}  // namespace
}  // namespace hitpipe::ref::encode_test
