// Traversal: DSA order (Table 4.2), suspension, and the answer compared with testing every triangle.
#include "sw_ref/trace/traversal.hpp"

#include <array>
#include <random>
#include <vector>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sw_ref/scene/scene.hpp"
#include "sw_ref/trace/slabs.hpp"
#include "tests/sw_ref/trace/tracer_scenes.hpp"

namespace hitpipe::ref::traversal_test {
namespace {

struct Spheres {
  Scene scene = load_scene("spheres");
  Bvh bvh = build_bvh(scene.mesh);
};

const Spheres& spheres_scene() {
  static const Spheres it;
  return it;
}

/// Rays from the eye, from surfaces and from anywhere, a third of them cut short.
std::vector<Ray> assorted_rays(const Scene& scene, int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> value(-0.95F, 0.95F);
  std::uniform_int_distribution<std::size_t> vertex(0, scene.mesh.vertices.size() - 1);
  std::vector<Ray> rays;
  for (int i = 0; i < count; ++i) {
    // Aiming at vertices makes the ray pass edges and corners of several triangles.
    const glm::vec3 target = scene.mesh.vertices[vertex(random)];
    const glm::vec3 anywhere(value(random), value(random), value(random));
    Ray ray{i % 2 ? scene.camera.eye : anywhere, {}, i % 3 ? Ray::infinite : 1.0F};
    if (i % 5 == 0) ray.origin = scene.mesh.vertices[vertex(random)];
    ray.direction = target - ray.origin;
    if (ray.direction == glm::vec3(0.0F)) ray.direction = {0.0F, 1.0F, 0.0F};
    rays.push_back(ray);
  }
  return rays;
}

TEST(Traversal, ChildOrderFollowsTable42) {
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
      mesh.vertices.insert(mesh.vertices.end(), {{x, -0.5F, -0.5F}, {x, 0.5F, -0.5F}, {x, 0.0F, 0.5F}});
    mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
    BuildOptions options;
    options.max_triangles = 1;
    bvh = build_bvh(mesh, options);
  }
};

TEST(Traversal, NearChildComesFirstAndItsHitCutsTheRay) {
  const TwoLeaves two;
  const Ray ray{{0.9F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}};
  Traversal traversal(two.bvh, two.mesh, ray, Query::closest);
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

TEST(Traversal, RootIsTestedAndItsMissEndsIt) {
  const TwoLeaves two;
  Traversal traversal(two.bvh, two.mesh, {{0, 0, 0}, {0, 1, 0}}, Query::closest);
  ASSERT_FALSE(traversal.done());
  traversal.answer(false);
  EXPECT_TRUE(traversal.done());
  EXPECT_FALSE(traversal.hit().found());
  EXPECT_EQ(traversal.counts(), TraceCounts::of_ray(1, 0));
}

TEST(Traversal, AnyStopsAtTheFirstTriangle) {
  const TwoLeaves two;
  const Ray ray{{0.9F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}};
  TraceCounts counts;
  EXPECT_TRUE(trace<ConservativeSlabs>(two.bvh, two.mesh, ray, Query::any, counts).found());
  EXPECT_EQ(counts, TraceCounts::of_ray(2, 1));
  const Ray too_short{ray.origin, ray.direction, 0.3F};
  EXPECT_FALSE(trace<ConservativeSlabs>(two.bvh, two.mesh, too_short, Query::any, counts).found());
}

TEST(Traversal, FindsWhatTestingEveryTriangleFinds) {
  const Spheres& it = spheres_scene();
  const std::vector<Ray> rays = assorted_rays(it.scene, 1200);
  std::size_t hits = 0;
  TraceCounts counts;
  for (const Ray& ray : rays) {
    const Hit expected = test_every_triangle(it.scene.mesh, ray);
    const Hit found = trace<ConservativeSlabs>(it.bvh, it.scene.mesh, ray, Query::closest, counts);
    ASSERT_EQ(found.triangle, expected.triangle);
    ASSERT_EQ(found.t_low, expected.t_low);
    ASSERT_EQ(found.t_high, expected.t_high);
    ASSERT_EQ(trace<ConservativeSlabs>(it.bvh, it.scene.mesh, ray, Query::any, counts).found(),
              expected.found());
    hits += expected.found() ? 1 : 0;
  }
  EXPECT_GT(hits, 900U);
  EXPECT_LT(counts.triangle_tests, rays.size() * 200);
}

/// A box test that culls nothing: the answer must not depend on the boxes.
struct AlwaysHit {
  explicit AlwaysHit(const Ray&) {}
  void cut(float) {}
  bool operator()(const Aabb&) const { return true; }
};

TEST(Traversal, AnswerDoesNotDependOnFalseHits) {
  const Spheres& it = spheres_scene();
  for (const Ray& ray : assorted_rays(it.scene, 40)) {
    TraceCounts counts;
    const Hit all = trace<AlwaysHit>(it.bvh, it.scene.mesh, ray, Query::closest, counts);
    EXPECT_EQ(counts.box_tests, it.bvh.nodes.size());
    EXPECT_EQ(counts.triangle_tests, it.scene.mesh.triangles.size());
    const Hit robust = trace<ConservativeSlabs>(it.bvh, it.scene.mesh, ray, Query::closest, counts);
    EXPECT_EQ(all.triangle, robust.triangle);
    EXPECT_EQ(all.t_low, robust.t_low);
  }
}

TEST(Traversal, SuspendedAndMovedTraversalsGoOnUnchanged) {
  const Spheres& it = spheres_scene();
  const std::vector<Ray> rays = assorted_rays(it.scene, 64);
  std::vector<Traversal> waiting;  // grows without reserve: its traversals are moved
  std::vector<ConservativeSlabs> tests;
  for (const Ray& ray : rays) {
    waiting.emplace_back(it.bvh, it.scene.mesh, ray, Query::closest);
    waiting.back().answer(true);
    tests.emplace_back(ray);
  }
  for (bool busy = true; busy;) {
    busy = false;
    for (std::size_t i = 0; i < waiting.size(); ++i) {
      Traversal& traversal = waiting[i];
      if (traversal.done()) continue;
      tests[i].cut(traversal.length());
      traversal.answer(tests[i](it.bvh.nodes[traversal.node()].box));
      busy = true;
    }
  }
  for (std::size_t i = 0; i < rays.size(); ++i) {
    TraceCounts counts;
    const Hit hit = trace<ConservativeSlabs>(it.bvh, it.scene.mesh, rays[i], Query::closest, counts);
    EXPECT_EQ(waiting[i].hit().triangle, hit.triangle);
    EXPECT_EQ(waiting[i].counts(), counts);
  }
}

TEST(Traversal, DeepestHierarchyFitsTheStack) {
  // Centres at powers of two leave one triangle per level: 60 levels, and the class MMM keeps every sibling
  // waiting.
  Mesh mesh;
  for (int i = 0; i < 100; ++i) {
    const float x = std::ldexp(1.0F, -i);
    mesh.vertices.insert(mesh.vertices.end(), {{x, -0.5F, -0.5F}, {x, 0.5F, -0.5F}, {x, 0.0F, 0.5F}});
    const auto base = static_cast<std::uint32_t>(3 * i);
    mesh.triangles.emplace_back(base, base + 1, base + 2);
  }
  BuildOptions options;
  options.max_triangles = 1;
  options.min_split = 0.0F;
  const Bvh bvh = build_bvh(mesh, options);
  ASSERT_EQ(bvh.depth, BuildOptions::deepest);
  for (const float side : {1.0F, -1.0F}) {
    const Ray ray{{side, 0.0F, 0.0F}, {-side, 0.0F, 0.0F}};
    TraceCounts counts;
    EXPECT_EQ(trace<AlwaysHit>(bvh, mesh, ray, Query::closest, counts).triangle, side > 0.0F ? 0U : 99U);
    EXPECT_EQ(counts.box_tests, bvh.nodes.size());
  }
}

}  // namespace
}  // namespace hitpipe::ref::traversal_test
