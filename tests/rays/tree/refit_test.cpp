// A hierarchy that gets another mesh: its branches stay, its boxes are the new triangles' own, and what has
// lost all its triangles is gone.
#include "rays/tree/refit.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

#include <gtest/gtest.h>

#include "tests/message_of.hpp"
#include "tests/rays/tree/hierarchies.hpp"

namespace hitpipe::ref::refit_test {
namespace {

using hierarchies::Random;

Aabb box_of(const Mesh& mesh, std::uint32_t triangle) {
  Aabb box;
  for (int corner = 0; corner < 3; ++corner) box.grow(mesh.vertices[mesh.triangles[triangle][corner]]);
  return box;
}

bool same(const Aabb& a, const Aabb& b) {
  return a.min == b.min && a.max == b.max;
}

/// Every node's box is the least one, children come behind their parents, and each triangle is in one leaf.
void expect_exact(const Bvh& bvh, const Mesh& mesh) {
  std::vector<int> seen(mesh.triangles.size());
  for (std::size_t i = bvh.nodes.size(); i-- > 0;) {
    const BvhNode& node = bvh.nodes[i];
    Aabb box;
    if (node.is_leaf()) {
      for (std::uint32_t k = 0; k < static_cast<std::uint32_t>(node.count); ++k) {
        box.grow(box_of(mesh, bvh.order[node.first + k]));
        ++seen[bvh.order[node.first + k]];
      }
    } else {
      ASSERT_GT(node.first, i);
      for (const std::uint32_t child : {node.first, node.first + 1}) box.grow(bvh.nodes[child].box);
    }
    ASSERT_TRUE(same(node.box, box)) << "node " << i;
  }
  EXPECT_TRUE(std::ranges::all_of(seen, [](int times) { return times == 1; }));
}

TEST(Refit, OfTheSameMeshIsTheHierarchyWithoutPadding) {
  Random random(hierarchies::seed);
  const Mesh mesh = hierarchies::spheres(random);
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  const Bvh padded = build_bvh(mesh, {.max_triangles = 3});
  const Bvh made = refitted(padded, mesh, all);
  const Bvh expected = build_bvh(mesh, {.max_triangles = 3, .padding = 0.0F});
  ASSERT_EQ(made.nodes.size(), expected.nodes.size());
  EXPECT_EQ(made.order, expected.order);
  EXPECT_EQ(made.depth, expected.depth);
  for (std::size_t i = 0; i < made.nodes.size(); ++i) {
    ASSERT_EQ(made.nodes[i].count, expected.nodes[i].count);
    ASSERT_EQ(made.nodes[i].first, expected.nodes[i].first);
  }
  expect_exact(made, mesh);
}

/// Of each number of triangles some have gone, and the others have moved.
TEST(Refit, LeavesOutTrianglesAndEmptyBranches) {
  Random random(hierarchies::seed);
  const Mesh mesh = hierarchies::spheres(random);
  const Bvh bvh = build_bvh(mesh, surface_area_build);
  for (const std::uint32_t one_in : {2U, 7U, 1000U}) {
    Mesh left;
    std::vector<std::uint32_t> numbers;
    for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
      if (random.bits() % one_in != 0) continue;
      numbers.push_back(i);
      const auto corner = [&](int k) { return mesh.vertices[mesh.triangles[i][k]] * 0.5F; };
      hierarchies::add(left, corner(0), corner(1), corner(2));
    }
    const Bvh made = refitted(bvh, left, numbers);
    expect_exact(made, left);
    EXPECT_LT(made.nodes.size(), bvh.nodes.size());
    EXPECT_EQ(made.order.size(), numbers.size());
    EXPECT_LE(made.depth, bvh.depth);
  }
}

TEST(Refit, RefusesATriangleThatIsInNoLeaf) {
  Random random(hierarchies::seed);
  const Mesh mesh = hierarchies::spheres(random);
  Bvh bvh = build_bvh(mesh);
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0U);
  std::ranges::replace(bvh.order, 17U, 18U);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { return refitted(bvh, mesh, all); }),
            "triangle 17 is in no leaf");
}

}  // namespace
}  // namespace hitpipe::ref::refit_test
