// Encoded nodes against the plain nodes: decoded boxes contain the plain boxes, nodes have the sizes of
// Tables 5.1 and 6.1, and a hierarchy that cannot be encoded is refused.
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

#include "sw_ref/adversary/random.hpp"
#include "sw_ref/bvh/bvh.hpp"
#include "sw_ref/encode/double_nodes.hpp"
#include "sw_ref/encode/hierarchical_nodes.hpp"
#include "sw_ref/encode/int_nodes.hpp"
#include "sw_ref/encode/relative_box.hpp"

namespace hitpipe::ref {
namespace {

using adversary::Random;

constexpr std::uint64_t seed = 20052;

glm::vec3 point(Random& random, float range) {
  return glm::vec3(random.signed_unit(), random.signed_unit(), random.signed_unit()) * range;
}

void add(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.emplace_back(first, first + 1, first + 2);
}

/// Small triangles near spheres.
Mesh spheres(Random& random) {
  Mesh mesh;
  for (int sphere = 0; sphere < 10; ++sphere) {
    const glm::vec3 centre = point(random, 0.7F);
    for (int i = 0; i < 400; ++i) {
      glm::vec3 on = point(random, 1);
      on *= 0.25F / std::sqrt(on.x * on.x + on.y * on.y + on.z * on.z);
      const glm::vec3 at = centre + on;
      add(mesh, at, at + point(random, 0.02F), at + point(random, 0.02F));
    }
  }
  return mesh;
}

/// In a plane of constant y, and some on a line: sides of zero width when boxes are not padded.
Mesh flat(Random& random) {
  Mesh mesh;
  const auto in_plane = [&] { return glm::vec3(random.signed_unit(), 0.3F, random.signed_unit()); };
  const auto on_line = [&] { return glm::vec3(-0.7F, random.signed_unit(), 1e-30F); };
  for (int i = 0; i < 1000; ++i) add(mesh, in_plane(), in_plane(), in_plane());
  for (int i = 0; i < 200; ++i) add(mesh, on_line(), on_line(), on_line());
  return mesh;
}

/// Each triangle is half as far from a corner of the cube as the one before, so the hierarchy is as deep as
/// possible.
Mesh deep(Random& random) {
  Mesh mesh;
  for (int i = 0; i < 120; ++i) {
    const glm::vec3 at = glm::vec3(-1) + std::ldexp(1.0F, -i / 3) * glm::vec3(1);
    const float size = std::ldexp(1.0F, -i / 3 - 2);
    add(mesh, at, at + point(random, size) * 0.5F, at + glm::vec3(0, size, 0) * 0.5F);
  }
  for (int i = 0; i < 120; ++i) {
    const float small = std::ldexp(1.0F, -i);
    add(mesh, {small, 0, 0}, {0, small, 0}, {0, 0, small});
  }
  return mesh;
}

struct Sample {
  const char* name;
  Mesh (*make)(Random& random);
  BuildOptions options;
};

BuildOptions options(int max_triangles, float padding, float min_split) {
  BuildOptions chosen;
  chosen.max_triangles = max_triangles;
  chosen.padding = padding;
  chosen.min_split = min_split;
  return chosen;
}

const std::vector<Sample>& samples() {
  static const std::vector<Sample> all{{"spheres", spheres, {}},
                                       {"spheres, single triangles", spheres, options(1, 5e-7F, 1e-6F)},
                                       {"flat", flat, {}},
                                       {"flat, not padded", flat, options(2, 0, 0)},
                                       {"deep", deep, options(1, 5e-7F, 1e-6F)},
                                       {"deep, not padded", deep, options(1, 0, 0)}};
  return all;
}

Bvh built(const Sample& sample) {
  Random random(seed);
  return build_bvh(sample.make(random), sample.options);
}

bool contains(const Aabb& outer, const Aabb& inner) {
  return glm::all(glm::lessThanEqual(outer.min, inner.min)) &&
         glm::all(glm::greaterThanEqual(outer.max, inner.max));
}

std::string describe(const Aabb& box) {
  return fmt::format("({:a}, {:a}, {:a}) to ({:a}, {:a}, {:a})", box.min.x, box.min.y, box.min.z, box.max.x,
                     box.max.y, box.max.z);
}

double surface(const Aabb& box) {
  const glm::dvec3 side = glm::dvec3(box.max) - glm::dvec3(box.min);
  return side.x * side.y + side.y * side.z + side.z * side.x;
}

/// Calls visit(node) for every node, parents first.
template <class Store>
void walk(const Store& store, const std::function<void(const typename Store::Node&)>& visit) {
  std::vector<typename Store::Node> pending{store.root()};
  while (!pending.empty()) {
    const auto node = pending.back();
    pending.pop_back();
    visit(node);
    if (store.count(node) > 0) continue;
    for (unsigned which = 0; which < 2; ++which) pending.push_back(store.child(node, which));
  }
}

/// Checks that every node occurs once, with its count and pointer; returns the number of nodes.
template <class Store>
std::size_t expect_same_tree(const Store& store, const Bvh& bvh) {
  std::vector<bool> seen(bvh.nodes.size());
  walk(store, [&](const typename Store::Node& node) {
    const std::uint32_t index = store.index(node);
    ASSERT_LT(index, seen.size());
    EXPECT_FALSE(seen[index]);
    seen[index] = true;
    EXPECT_EQ(store.count(node), bvh.nodes[index].count);
    EXPECT_EQ(store.first(node), bvh.nodes[index].first);
  });
  EXPECT_EQ(store.size(), bvh.nodes.size());
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
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

/// The message of the exception.
template <class Exception>
std::string refusal(const std::function<void()>& encode) {
  try {
    encode();
  } catch (const Exception& error) {
    return error.what();
  }
  return "accepted";
}

template <class Store>
std::string refusal_of(const Bvh& bvh) {
  return refusal<std::invalid_argument>([&] { const Store store(bvh); });
}

Bvh one_leaf(std::int32_t count) {
  Bvh bvh;
  bvh.nodes.push_back({{glm::vec3(-0.5F), glm::vec3(0.5F)}, count, 0});
  return bvh;
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
}  // namespace hitpipe::ref
