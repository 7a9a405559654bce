// What holds for every hierarchy with any builder, mesh and number of threads, and how the builders differ.
#include <algorithm>
#include <cstring>

#include <gtest/gtest.h>

#include "rays/exact/grid.hpp"
#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"
#include "sw_ref/hierarchy/statistics.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/rays/tree/meshes.hpp"

namespace hitpipe::ref::builders_test {
namespace {

struct NamedMesh {
  const char* name;
  Mesh (*make)();

  friend void PrintTo(const NamedMesh& mesh, std::ostream* out) { *out << mesh.name; }
};

/// The hills and Spheres are larger than one thread's subtree, and the hills also larger than one block of a
/// pass.
const std::vector<NamedMesh> meshes{
    {"spheres", [] { return load_scene("spheres").mesh; }},
    {"hills", [] { return hills(240, 0.2F); }},
    {"soup", [] { return soup(3'000, 0.05F); }},
    {"soup_of_large_ones", [] { return soup(500, 0.5F); }},
    {"flat", [] { return hills(40, 0.0F); }},
    {"one", [] { return coincident(1); }},
    {"coincident", [] { return coincident(100'000); }},
    {"concentric", [] { return concentric(1'000); }},
    {"tiny", [] { return triangles_at(std::vector<glm::vec3>(40), 1e-9F); }},
};

Aabb triangle_box(const Mesh& mesh, std::uint32_t triangle) {
  const Mesh::Corners corners = mesh.corners(triangle);
  Aabb box;
  for (const glm::vec3& p : {corners.a, corners.b, corners.c}) box.grow(p);
  return box;
}

/// The bounds of each node, computed from its triangles.
struct Below {
  std::size_t triangles = 0;
  Aabb box;
  Aabb centres;
};

std::vector<Below> from_triangles(const Mesh& mesh, const Bvh& bvh) {
  std::vector<Below> below(bvh.nodes.size());
  for (std::size_t i = bvh.nodes.size(); i-- > 0;) {
    const BvhNode& node = bvh.nodes[i];
    if (node.is_leaf()) {
      below[i].triangles = static_cast<std::size_t>(node.count);
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(node.count); ++k) {
        const Aabb box = triangle_box(mesh, bvh.order[node.first + k]);
        below[i].box.grow(box);
        below[i].centres.grow((box.min + box.max) * 0.5F);
      }
      continue;
    }
    for (const std::uint32_t child : {node.first, node.first + 1}) {
      below[i].triangles += below[child].triangles;
      below[i].box.grow(below[child].box);
      below[i].centres.grow(below[child].centres);
    }
  }
  return below;
}

bool same_bits(const Bvh& a, const Bvh& b) {
  return a.nodes.size() == b.nodes.size() && a.order == b.order && a.depth == b.depth &&
         std::memcmp(a.nodes.data(), b.nodes.data(), a.nodes.size() * sizeof(BvhNode)) == 0;
}

class Builders : public testing::TestWithParam<std::tuple<Builder, NamedMesh>> {
 protected:
  const Mesh mesh_ = std::get<NamedMesh>(GetParam()).make();
  const BuildOptions options_{.builder = std::get<Builder>(GetParam())};
  const Bvh bvh_ = build_bvh(mesh_, options_);
};

TEST_P(Builders, EveryTriangleIsInOneLeaf) {
  std::vector<std::uint32_t> sorted = bvh_.order;
  std::sort(sorted.begin(), sorted.end());
  ASSERT_EQ(sorted.size(), mesh_.triangles.size());
  for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
  std::vector<std::uint32_t> starts;
  for (const BvhNode& node : bvh_.nodes)
    if (node.is_leaf()) starts.push_back(node.first);
  std::sort(starts.begin(), starts.end());
  std::size_t in_leaves = 0;
  for (const BvhNode& node : bvh_.nodes) {
    if (!node.is_leaf()) continue;
    in_leaves += static_cast<std::size_t>(node.count);
    const auto next = std::upper_bound(starts.begin(), starts.end(), node.first);
    const std::size_t end = next == starts.end() ? bvh_.order.size() : *next;
    ASSERT_EQ(node.first + static_cast<std::size_t>(node.count), end);
  }
  EXPECT_EQ(in_leaves, mesh_.triangles.size());
}

TEST_P(Builders, BoxesAreThePaddedBoundsOfTheirTriangles) {
  const std::vector<Below> below = from_triangles(mesh_, bvh_);
  for (std::size_t i = 0; i < bvh_.nodes.size(); ++i) {
    ASSERT_EQ(bvh_.nodes[i].box.min, below[i].box.min - options_.padding) << i;
    ASSERT_EQ(bvh_.nodes[i].box.max, below[i].box.max + options_.padding) << i;
  }
}

TEST_P(Builders, ChildrenFollowInTheOrderOfTheWalk) {
  std::uint32_t next = 1;
  int depth = 0;
  std::vector<std::pair<std::uint32_t, int>> pending{{0, 1}};
  while (!pending.empty()) {
    const auto [index, level] = pending.back();
    pending.pop_back();
    depth = std::max(depth, level);
    const BvhNode& node = bvh_.nodes[index];
    if (node.is_leaf()) continue;
    ASSERT_GE(node.count, -3);
    ASSERT_EQ(node.first, next);
    next += 2;
    pending.emplace_back(node.first + 1, level + 1);
    pending.emplace_back(node.first, level + 1);
  }
  EXPECT_EQ(next, bvh_.nodes.size());
  EXPECT_EQ(depth, bvh_.depth);
  EXPECT_LE(depth, options_.max_depth);
}

TEST_P(Builders, CentresOfChild0AreBelowThoseOfChild1) {
  const std::vector<Below> below = from_triangles(mesh_, bvh_);
  for (const BvhNode& node : bvh_.nodes) {
    if (node.is_leaf()) continue;
    const Aabb& low = below[node.first].centres;
    const Aabb& high = below[node.first + 1].centres;
    const int axis = node.split_axis();
    // If no axis separates the centres, the list was halved.
    if (low.min == high.min && low.max == high.max && low.min == low.max) continue;
    ASSERT_LT(low.max[axis], high.min[axis]);
  }
}

TEST_P(Builders, OnlyNarrowNodesAreLargeLeaves) {
  const std::vector<Below> below = from_triangles(mesh_, bvh_);
  for (std::size_t i = 0; i < bvh_.nodes.size(); ++i) {
    if (bvh_.nodes[i].count <= options_.max_triangles) continue;
    for (int axis = 0; axis < 3; ++axis)
      ASSERT_LT(below[i].box.max[axis] - below[i].box.min[axis], options_.min_split) << i;
  }
}

TEST_P(Builders, ThreadsChangeNoBit) {
  for (const int threads : {1, 2, 8}) {
    BuildOptions options = options_;
    options.threads = threads;
    EXPECT_TRUE(same_bits(build_bvh(mesh_, options), bvh_)) << threads;
  }
}

INSTANTIATE_TEST_SUITE_P(
    AllMeshes, Builders,
    testing::Combine(testing::Values(Builder::median, Builder::sah), testing::ValuesIn(meshes)),
    [](const auto& parameter) {
      return std::string(std::get<Builder>(parameter.param) == Builder::sah ? "sah_" : "median_") +
             std::get<NamedMesh>(parameter.param).name;
    });

class Meshes : public testing::TestWithParam<NamedMesh> {};

TEST_P(Meshes, CostNoMoreBySah) {
  const Mesh mesh = GetParam().make();
  const auto cost = [&](Builder builder) {
    return statistics(build_bvh(mesh, {.builder = builder})).sah_cost;
  };
  EXPECT_LE(cost(Builder::sah), cost(Builder::median));
}

INSTANTIATE_TEST_SUITE_P(OfAllKinds, Meshes, testing::ValuesIn(meshes),
                         [](const auto& parameter) { return std::string(parameter.param.name); });

TEST(Sah, SplitsWhereItIsCheapestNotInTheMiddle) {
  // Seven close together, one far away: the middle of the box would separate the seven.
  std::vector<glm::vec3> centres{{0.9F, 0.0F, 0.0F}};
  for (int i = 0; i < 7; ++i) centres.emplace_back(-0.1F + 0.02F * static_cast<float>(i), 0.0F, 0.0F);
  centres.emplace_back(-0.9F, 0.0F, 0.0F);
  const Bvh bvh = build_bvh(triangles_at(centres), {.builder = Builder::sah, .max_triangles = 7});
  ASSERT_EQ(bvh.nodes[0].split_axis(), 0);
  const BvhNode& high = bvh.nodes[2];
  const BvhNode& low = bvh.nodes[1];
  const bool one_apart = (low.is_leaf() && low.count == 1) || (high.is_leaf() && high.count == 1);
  EXPECT_TRUE(one_apart) << low.count << " " << high.count;
}

TEST(Sah, LeafIsMadeWhereItIsCheaper) {
  // Large triangles that nearly coincide: each child would be as large as the node.
  std::vector<glm::vec3> centres;
  for (int i = 0; i < 6; ++i) centres.emplace_back(0.001F * static_cast<float>(i), 0.0F, 0.0F);
  const Mesh mesh = triangles_at(centres, 0.5F);
  EXPECT_EQ(build_bvh(mesh, {.builder = Builder::sah, .max_triangles = 6}).nodes.size(), 1U);
  const Bvh forced = build_bvh(mesh, {.builder = Builder::sah, .max_triangles = 5});
  EXPECT_EQ(forced.nodes.size(), 3U);
  // Small triangles far apart are separated, although one leaf could hold them.
  const Mesh apart = triangles_at({{-0.9F, 0, 0}, {-0.8F, 0, 0}, {0.9F, 0.9F, 0}, {0.8F, 0.9F, 0}});
  EXPECT_EQ(build_bvh(apart, {.builder = Builder::sah, .max_triangles = 6}).nodes.size(), 7U);
}

TEST(Sah, NarrowAxisIsNotSplit) {
  // Separated equally well along x and y; the box is 0.06 wide along x, 0.41 along y.
  const Mesh mesh = triangles_at({{0.0F, -0.2F, 0.0F}, {0.05F, 0.2F, 0.0F}});
  BuildOptions options{.builder = Builder::sah, .max_triangles = 1};
  EXPECT_EQ(build_bvh(mesh, options).nodes[0].split_axis(), 0);
  options.min_split = 0.1F;
  EXPECT_EQ(build_bvh(mesh, options).nodes[0].split_axis(), 1);
  options.min_split = 0.42F;
  EXPECT_TRUE(build_bvh(mesh, options).nodes[0].is_leaf());
}

class Grid : public testing::TestWithParam<Builder> {};

TEST_P(Grid, MakesLeavesOfNodesNoWiderThanAUnit) {
  const Mesh mesh = hills(60, 0.1F);
  for (const int bits : {6, 7, 8, 10}) {
    const double unit = 1.0 / static_cast<double>(grid_scale(bits));
    const BuildOptions options{.builder = GetParam(), .max_triangles = 1, .grid_bits = bits};
    const Bvh bvh = build_bvh(mesh, options);
    const std::vector<Below> below = from_triangles(mesh, bvh);
    std::size_t large = 0;
    for (std::size_t i = 0; i < bvh.nodes.size(); ++i) {
      const BvhNode& node = bvh.nodes[i];
      const glm::vec3 extent = below[i].box.max - below[i].box.min;
      if (!node.is_leaf()) {
        // If no wide axis separates a list, it is halved, and its axis has no meaning.
        const bool halved = below[node.first].triangles == below[i].triangles / 2;
        ASSERT_TRUE(halved || extent[node.split_axis()] >= unit);
      } else if (node.count > 1) {
        ++large;
        for (int axis = 0; axis < 3; ++axis) ASSERT_LT(extent[axis], unit);
      }
    }
    // A cell is 0.03 wide, the units are 1/15, 1/31, 1/63, 1/255.
    EXPECT_EQ(large > 0, bits < 8) << bits;
  }
}

TEST_P(Grid, FinerThanTheLeastWidthChangesNothing) {
  const Mesh mesh = soup(500, 0.05F);
  const BuildOptions options{.builder = GetParam()};
  BuildOptions with_grid = options;
  with_grid.grid_bits = 24;
  EXPECT_TRUE(same_bits(build_bvh(mesh, options), build_bvh(mesh, with_grid)));
}

INSTANTIATE_TEST_SUITE_P(Both, Grid, testing::Values(Builder::median, Builder::sah),
                         [](const auto& parameter) {
                           return parameter.param == Builder::sah ? "sah" : "median";
                         });

}  // namespace
}  // namespace hitpipe::ref::builders_test
