// The hierarchy of section 4.3, rule by rule on meshes of a few triangles.
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "rays/scene/scene.hpp"
#include "rays/tree/bvh.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"
#include "tests/rays/tree/meshes.hpp"

namespace hitpipe::ref::build_test {
namespace {

BuildOptions one_per_leaf() {
  BuildOptions options;
  options.max_triangles = 1;
  return options;
}

bool contains(const Aabb& outer, const glm::vec3& p) {
  for (int k = 0; k < 3; ++k)
    if (p[k] < outer.min[k] || p[k] > outer.max[k]) return false;
  return true;
}

TEST(Build, AxesAlternateAndChild0IsOnTheNegativeSide) {
  std::vector<glm::vec3> corners;
  for (const float x : {0.5F, -0.5F})
    for (const float y : {0.5F, -0.5F})
      for (const float z : {0.5F, -0.5F}) corners.emplace_back(x, y, z);
  const Bvh bvh = build_bvh(triangles_at(corners), one_per_leaf());
  ASSERT_EQ(bvh.nodes.size(), 15U);
  EXPECT_EQ(bvh.depth, 4);
  int branches = 0;
  std::vector<std::pair<std::uint32_t, int>> pending{{0, 0}};
  while (!pending.empty()) {
    const auto [index, axis] = pending.back();
    pending.pop_back();
    const BvhNode& node = bvh.nodes[index];
    if (node.is_leaf()) continue;
    ++branches;
    EXPECT_EQ(node.split_axis(), axis);
    EXPECT_LT(bvh.nodes[node.first].box.max[axis], 0.0F);
    EXPECT_GT(bvh.nodes[node.first + 1].box.min[axis], 0.0F);
    pending.emplace_back(node.first, axis + 1);
    pending.emplace_back(node.first + 1, axis + 1);
  }
  EXPECT_EQ(branches, 7);
}

TEST(Build, EmptyChildMovesToTheNextAxisWhichIsRecorded) {
  // Along x every centre is at or above the middle of the box, which one wide triangle stretches.
  Mesh mesh = triangles_at({{0.4F, 0.1F, 0.0F}, {0.4F, 0.8F, 0.0F}});
  mesh.vertices.insert(mesh.vertices.end(), {{0.3F, 0.3F, 0.0F}, {0.5F, 0.3F, 0.0F}, {0.5F, 0.31F, 0.0F}});
  mesh.triangles.emplace_back(6, 7, 8);
  const Bvh bvh = build_bvh(mesh, one_per_leaf());
  ASSERT_FALSE(bvh.nodes[0].is_leaf());
  EXPECT_EQ(bvh.nodes[0].split_axis(), 1);
  const BvhNode& low = bvh.nodes[bvh.nodes[0].first];
  EXPECT_LT(low.box.max.y, 0.4F);
  // The next level starts with the axis after the one used: z is too narrow, x separates nothing, y does.
  ASSERT_FALSE(low.is_leaf());
  EXPECT_EQ(low.split_axis(), 1);
}

TEST(Build, CentreOnTheMidpointGoesToChild1) {
  const Bvh bvh = build_bvh(
      triangles_at({{-0.5F, 0.0F, 0.0F}, {0.0F, 0.0F, 0.0F}, {0.5F, 0.0F, 0.0F}}, 0.125F), one_per_leaf());
  ASSERT_EQ(bvh.nodes.size(), 5U);
  EXPECT_TRUE(bvh.nodes[1].is_leaf());
  EXPECT_FALSE(bvh.nodes[2].is_leaf());
}

TEST(Build, NarrowAxisIsNotSplit) {
  BuildOptions options = one_per_leaf();
  const Mesh mesh = triangles_at({{-0.1F, -0.2F, 0.0F}, {0.1F, 0.2F, 0.0F}});
  EXPECT_EQ(build_bvh(mesh, options).nodes[0].split_axis(), 0);
  options.min_split = 0.3F;  // the box is 0.21 wide along x, 0.41 along y
  EXPECT_EQ(build_bvh(mesh, options).nodes[0].split_axis(), 1);
  options.min_split = 0.5F;
  EXPECT_TRUE(build_bvh(mesh, options).nodes[0].is_leaf());
}

TEST(Build, InseparableTrianglesAreHalved) {
  const Bvh bvh = build_bvh(triangles_at(std::vector<glm::vec3>(13)));
  ASSERT_EQ(bvh.nodes.size(), 5U);
  EXPECT_EQ(bvh.nodes[0].split_axis(), 0);
  EXPECT_EQ(bvh.nodes[1].count, 6);
  EXPECT_EQ(bvh.nodes[2].count, -2);  // 7 triangles, next axis
  EXPECT_EQ(bvh.nodes[3].count, 3);
  EXPECT_EQ(bvh.nodes[4].count, 4);
  const Bvh pair = build_bvh(triangles_at(std::vector<glm::vec3>(2)), one_per_leaf());
  ASSERT_EQ(pair.nodes.size(), 3U);
  EXPECT_EQ(pair.nodes[1].count, 1);
  EXPECT_EQ(pair.nodes[2].count, 1);
}

TEST(Build, NodeTooNarrowAlongAllAxesIsALeaf) {
  const Bvh bvh = build_bvh(triangles_at(std::vector<glm::vec3>(20), 4e-7F));
  ASSERT_EQ(bvh.nodes.size(), 1U);
  EXPECT_EQ(bvh.nodes[0].count, 20);
  EXPECT_EQ(bvh.depth, 1);
}

TEST(Build, DepthIsLimited) {
  BuildOptions options = one_per_leaf();
  options.max_depth = 3;
  const Bvh bvh = build_bvh(triangles_at(std::vector<glm::vec3>(40)), options);
  EXPECT_EQ(bvh.depth, 3);
  EXPECT_EQ(bvh.nodes.size(), 7U);
  for (std::size_t i = 3; i < 7; ++i) EXPECT_EQ(bvh.nodes[i].count, 10);
  // Each halving of the box takes one of these off: 100 levels without the limit of section 4.3.
  std::vector<glm::vec3> centres;
  for (int i = 0; i < 100; ++i) centres.emplace_back(std::ldexp(1.0F, -i), 0.0F, 0.0F);
  options = one_per_leaf();
  options.min_split = 0.0F;
  EXPECT_EQ(build_bvh(triangles_at(centres, 0.0F), options).depth, 60);
}

TEST(Build, BoxesArePaddedOutward) {
  const Mesh mesh = triangles_at({{0.25F, -0.75F, 0.0F}});
  const Bvh bvh = build_bvh(mesh);
  Aabb bounds;
  for (const glm::vec3& p : mesh.vertices) bounds.grow(p);
  for (int k = 0; k < 3; ++k) {
    EXPECT_LT(bvh.nodes[0].box.min[k], bounds.min[k]);
    EXPECT_GT(bvh.nodes[0].box.max[k], bounds.max[k]);
    EXPECT_NEAR(bounds.min[k] - bvh.nodes[0].box.min[k], 5e-7, 6e-8);
    EXPECT_NEAR(bvh.nodes[0].box.max[k] - bounds.max[k], 5e-7, 6e-8);
  }
  BuildOptions below_resolution;
  below_resolution.padding = 1e-9F;
  const Bvh thin = build_bvh(mesh, below_resolution);
  for (const glm::vec3& p : mesh.vertices) EXPECT_TRUE(contains(thin.nodes[0].box, p));
}

TEST(Build, SpheresHasHalfAsManyNodesAsTriangles) {
  // Appendix B, at 6 triangles per leaf.
  const Bvh bvh = build_bvh(load_scene("spheres").mesh);
  EXPECT_GT(bvh.nodes.size(), 24'578U * 45 / 100);
  EXPECT_LT(bvh.nodes.size(), 24'578U * 55 / 100);
}

TEST(Build, OptionsOutOfRangeAreRejected) {
  const Mesh mesh = triangles_at({{0, 0, 0}});
  const auto error = [&](auto change) {
    BuildOptions options;
    change(options);
    return message_of<std::exception>([&] { return build_bvh(mesh, options); });
  };
  EXPECT_EQ(message_of<std::exception>([] { return build_bvh(Mesh{}); }),
            "BVH: the mesh has no triangle; at least 1 is needed");
  EXPECT_EQ(error([](BuildOptions& o) { o.max_triangles = 0; }),
            "BVH: 0 triangles per leaf; at least 1 is needed");
  EXPECT_EQ(error([](BuildOptions& o) { o.max_depth = 61; }),
            "BVH: a depth of 61 levels; allowed are 1 to 60");
  EXPECT_EQ(error([](BuildOptions& o) { o.max_depth = 0; }), "BVH: a depth of 0 levels; allowed are 1 to 60");
  const std::string widths = "BVH: padding and smallest split width must be numbers that are not negative";
  EXPECT_EQ(error([](BuildOptions& o) { o.padding = -1e-7F; }), widths);
  EXPECT_EQ(error([](BuildOptions& o) { o.padding = INFINITY; }), widths);
  EXPECT_EQ(error([](BuildOptions& o) { o.min_split = NAN; }), widths);
  EXPECT_EQ(error([](BuildOptions& o) { o.grid_bits = 5; }),
            "BVH: a grid of 5 bits; allowed are 6 to 32, or 0 for none");
  EXPECT_EQ(error([](BuildOptions& o) { o.grid_bits = 33; }),
            "BVH: a grid of 33 bits; allowed are 6 to 32, or 0 for none");
  EXPECT_EQ(error([](BuildOptions& o) { o.threads = -1; }),
            "BVH: -1 threads; at least 1 is needed, or 0 for one a core");
}

}  // namespace
}  // namespace hitpipe::ref::build_test
