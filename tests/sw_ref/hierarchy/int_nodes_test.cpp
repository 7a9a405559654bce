// Nodes with integer planes: packing keeps every box, nodes have the sizes of Table 6.1, and a box that
// leaves the grid is refused.
#include "sw_ref/hierarchy/int_nodes.hpp"

#include <gtest/gtest.h>

#include "tests/rays/tree/hierarchies.hpp"

namespace hitpipe::ref::int_nodes_test {
namespace {

using hierarchies::built;
using hierarchies::describe;
using hierarchies::expect_same_tree;
using hierarchies::one_leaf;
using hierarchies::refusal;
using hierarchies::samples;
TEST(IntNodes, NodesHaveTheSizesOfTable6_1) {
  const Bvh bvh = one_leaf(1);
  EXPECT_EQ(IntNodes(bvh, 16).bytes_per_node, 20U);
  EXPECT_EQ(IntNodes(bvh, 20).bytes_per_node, 23U);
  EXPECT_EQ(IntNodes(bvh, 24).bytes_per_node, 26U);
  EXPECT_EQ(IntNodes(bvh, 6).bytes_per_node, 13U);
  EXPECT_EQ(IntNodes(bvh, 32).bytes_per_node, 32U);
}

TEST(IntNodes, PackingReturnsTheQuantisedBoxesForEveryNumberOfBits) {
  const Bvh bvh = built(samples().front());
  for (int coord_bits = 6; coord_bits <= 32; ++coord_bits) {
    const IntNodes store(bvh, coord_bits);
    EXPECT_EQ(expect_same_tree(store, bvh), bvh.nodes.size());
    for (std::uint32_t i = 0; i < bvh.nodes.size(); ++i) {
      ASSERT_EQ(store.box(i), quantise_box(bvh.nodes[i].box, coord_bits))
          << coord_bits << " bits, node " << i << ", " << describe(bvh.nodes[i].box);
    }
  }
}

TEST(IntNodes, PackingReturnsTheBoxesGrownForAFinerOrigin) {
  const Bvh bvh = built(samples().front());
  int smaller = 0;
  for (int finer = 0; finer <= 3; ++finer) {
    const IntNodes store(bvh, 12, {}, finer);
    EXPECT_EQ(expect_same_tree(store, bvh), bvh.nodes.size());
    for (std::uint32_t i = 0; i < bvh.nodes.size(); ++i) {
      ASSERT_EQ(store.box(i), quantise_box(bvh.nodes[i].box, 12, finer)) << finer << ", node " << i;
      smaller += store.box(i) == quantise_box(bvh.nodes[i].box, 12) ? 0 : 1;
    }
  }
  EXPECT_GT(smaller, 0);
}

TEST(IntNodes, CoarseAxesTakeTheirBitsFromTheNodes) {
  const Bvh bvh = one_leaf(1);
  EXPECT_EQ(IntNodes(bvh, 16, {{0, 4, 0}}).bytes_per_node, 19U);
  EXPECT_EQ(IntNodes(bvh, 16, {{1, 1, 1}}).bytes_per_node, 20U);  // 90 bits: 12 bytes still
  EXPECT_EQ(IntNodes(bvh, 6, {{3, 3, 3}}).bytes_per_node, 11U);
  EXPECT_EQ(IntNodes(bvh, 32, {{29, 29, 29}}).bytes_per_node, 11U);
}

TEST(IntNodes, PackingReturnsTheCoarseBoxesForEveryNumberOfBits) {
  const Bvh bvh = built(samples().front());
  std::size_t run = 0;
  for (int coord_bits = 6; coord_bits <= 32; ++coord_bits) {
    for (int k = 1; k <= coord_bits - 4; k += 3) {
      const CoarseAxes coarse{{k, k % 2, (k + 7) % (coord_bits - 4)}};
      const IntNodes store(bvh, coord_bits, coarse);
      EXPECT_EQ(expect_same_tree(store, bvh), bvh.nodes.size());
      for (std::uint32_t i = 0; i < bvh.nodes.size(); ++i, ++run) {
        ASSERT_EQ(store.box(i), coarse_box(quantise_box(bvh.nodes[i].box, coord_bits), coarse, coord_bits))
            << coord_bits << " bits, dropped " << to_text(coarse) << ", node " << i;
      }
    }
  }
  EXPECT_GT(run, 100 * bvh.nodes.size());
}

TEST(IntNodes, BitsAndBoxesOutsideTheGridAreRejected) {
  EXPECT_EQ(refusal<std::invalid_argument>([] { const IntNodes store(one_leaf(1), 33); }),
            "quantise_box: 33 coordinate bits; allowed are 6 to 32");
  Bvh bvh = one_leaf(1);
  bvh.nodes[0].box.max.x = 1.5F;
  EXPECT_EQ(refusal<std::out_of_range>([&] { const IntNodes store(bvh, 16); }),
            "quantise_box: max.x = 1.5 leaves the 16-bit grid; boxes must lie within [-1, 1]");
  EXPECT_EQ(refusal<std::out_of_range>([] {
              const IntNodes store(one_leaf(1), 16, {{0, 14, 0}});
            }),
            "coarse axes: min.y = -32768 leaves the 16-bit grid; drop fewer than 14 low bits of y");
  EXPECT_EQ(refusal<std::invalid_argument>([] {
              const IntNodes store(one_leaf(1), 16, {{15, 0, 0}});
            }),
            "IntNodes: 15 dropped bits of x; of 16 bits 0 to 14 can be dropped");
}

}  // namespace
}  // namespace hitpipe::ref::int_nodes_test
