// Walks: DSA order (Table 4.2), suspension, and that false hits change no answer.
#include "rays/trace/walk.hpp"

#include <array>
#include <vector>

#include <gtest/gtest.h>

#include "rays/trace/slabs.hpp"
#include "sw_ref/trace/traversal.hpp"
#include "tests/rays/trace/tracer_scenes.hpp"

namespace hitpipe::ref::walk_test {
namespace {

struct Hills {
  Random random{7};
  Mesh mesh = hills(24);
  Bvh bvh = build_bvh(mesh);
  std::vector<Ray> rays = special_rays(random, mesh, 64);
};

TEST(BoxWalk, ChildOrderFollowsTable42) {
  struct Row {
    const char* ray_class;
    std::array<unsigned, 3> first_child;  // of a branch split along x, y, z
  };
  constexpr std::array<Row, 8> table{{{"MMM", {1, 1, 1}},
                                      {"MMP", {1, 1, 0}},
                                      {"MPM", {1, 0, 1}},
                                      {"MPP", {1, 0, 0}},
                                      {"PMM", {0, 1, 1}},
                                      {"PMP", {0, 1, 0}},
                                      {"PPM", {0, 0, 1}},
                                      {"PPP", {0, 0, 0}}}};
  for (const Row& row : table) {
    for (const float size : {1.0F, 0.0F}) {  // -0 is M, +0 is P
      glm::vec3 direction;
      for (int k = 0; k < 3; ++k) direction[k] = row.ray_class[k] == 'M' ? -size : size;
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_EQ(near_child(direction_class(direction), axis),
                  row.first_child[static_cast<std::size_t>(axis)])
            << row.ray_class << " axis " << axis;
    }
  }
}

/// Two triangles across the x axis at x = -0.5 and 0.5, one per leaf.
struct TwoLeaves {
  Mesh mesh;
  Bvh bvh;

  TwoLeaves() {
    for (const float x : {-0.5F, 0.5F})
      add_triangle(mesh, {x, -0.5F, -0.5F}, {x, 0.5F, -0.5F}, {x, 0.0F, 0.5F});
    bvh = build_bvh(mesh, {.max_triangles = 1});
  }
};

TEST(BoxWalk, NearChildComesFirstAndItsHitCutsTheRay) {
  const TwoLeaves two;
  const Ray ray{{0.9F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}};
  BoxWalk traversal(two.bvh, FloatWorld(two.mesh, two.bvh, ray), Query::closest);
  EXPECT_EQ(traversal.node(), 0U);
  EXPECT_EQ(traversal.length(), Ray::infinite);
  traversal.answer(true);
  EXPECT_EQ(traversal.node(), 2U);  // child 1 lies at x = 0.5
  traversal.answer(true);
  EXPECT_EQ(traversal.node(), 1U);
  EXPECT_EQ(traversal.hit().triangle, 1U);
  EXPECT_EQ(traversal.length(), cull_length(traversal.hit()));
  EXPECT_NEAR(traversal.length(), 0.4F, 1e-6F);
  traversal.answer(false);
  EXPECT_TRUE(traversal.done());
  EXPECT_EQ(traversal.counts(), TraceCounts::of_ray(3, 1));
}

TEST(BoxWalk, RootIsTestedAndItsMissEndsIt) {
  const TwoLeaves two;
  BoxWalk traversal(two.bvh, FloatWorld(two.mesh, two.bvh, {{0, 0, 0}, {0, 1, 0}}), Query::closest);
  ASSERT_FALSE(traversal.done());
  traversal.answer(false);
  EXPECT_TRUE(traversal.done());
  EXPECT_FALSE(traversal.hit().found());
  EXPECT_EQ(traversal.counts(), TraceCounts::of_ray(1, 0));
}

TEST(BoxWalk, AnyStopsAtTheFirstTriangle) {
  const TwoLeaves two;
  const Ray ray{{0.9F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}};
  TraceCounts counts;
  EXPECT_TRUE(trace<ConservativeSlabs>(two.bvh, two.mesh, ray, Query::any, counts).found());
  EXPECT_EQ(counts, TraceCounts::of_ray(2, 1));
  const Ray too_short{ray.origin, ray.direction, 0.3F};
  EXPECT_FALSE(trace<ConservativeSlabs>(two.bvh, two.mesh, too_short, Query::any, counts).found());
}

/// A box test that culls nothing: the answer must not depend on the boxes.
struct AlwaysHit {
  explicit AlwaysHit(const Ray&) {}
  void cut(float) {}
  bool operator()(const Aabb&) const { return true; }
};

TEST(BoxWalk, AnswerDoesNotDependOnFalseHits) {
  const Hills it;
  for (const Ray& ray : it.rays) {
    TraceCounts counts;
    const Hit all = trace<AlwaysHit>(it.bvh, it.mesh, ray, Query::closest, counts);
    EXPECT_EQ(counts.box_tests, it.bvh.nodes.size());
    EXPECT_EQ(counts.triangle_tests, it.mesh.triangles.size());
    const Hit conservative = trace<ConservativeSlabs>(it.bvh, it.mesh, ray, Query::closest, counts);
    EXPECT_EQ(all.triangle, conservative.triangle);
    EXPECT_EQ(all.t_low, conservative.t_low);
  }
}

TEST(BoxWalk, SuspendedAndMovedTraversalsGoOnUnchanged) {
  const Hills it;
  std::vector<BoxWalk<FloatWorld>> waiting;  // grows without reserve: its traversals are moved
  std::vector<ConservativeSlabs> tests;
  for (const Ray& ray : it.rays) {
    tests.emplace_back(ray);
    waiting.emplace_back(it.bvh, FloatWorld(it.mesh, it.bvh, ray), Query::closest);
    waiting.back().answer(tests.back()(it.bvh.nodes[0].box));
  }
  for (bool busy = true; busy;) {
    busy = false;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      BoxWalk<FloatWorld>& traversal = waiting[i];
      if (traversal.done()) continue;
      tests[i].cut(traversal.length());
      traversal.answer(tests[i](it.bvh.nodes[traversal.node()].box));
      busy = true;
    }
  }
  for (std::size_t i = 0; i < it.rays.size(); ++i) {
    TraceCounts counts;
    const Hit hit = trace<ConservativeSlabs>(it.bvh, it.mesh, it.rays[i], Query::closest, counts);
    EXPECT_EQ(waiting[i].hit().triangle, hit.triangle);
    EXPECT_EQ(waiting[i].counts(), counts);
  }
}

}  // namespace
}  // namespace hitpipe::ref::walk_test
