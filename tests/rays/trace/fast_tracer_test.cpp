// The fast tracer finds what testing every triangle finds, with vectors of four and of eight. Its filter
// discards only triangles that the exact test finds missed. Wide nodes whose children are tested together
// load and count what they do when children are tested one by one.
#include "rays/trace/fast_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "rays/trace/leaf.hpp"
#include "rays/trace/near_first.hpp"
#include "rays/trace/triangle_pack.hpp"
#include "rays/tree/wide_nodes.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "tests/message_of.hpp"
#include "tests/rays/trace/tracer_scenes.hpp"

namespace hitpipe::ref::fast_tracer_test {
namespace {

constexpr unsigned seed = 23;

std::vector<VectorWidth> widths() {
  std::vector<VectorWidth> all{VectorWidth::best, VectorWidth::four};
  if (has_vectors(VectorWidth::eight)) all.push_back(VectorWidth::eight);
  return all;
}

std::vector<Mesh> meshes(Random& random) {
  return {soup(random, 500), grid_soup(random, 150), hills(14), soup(random, 3)};
}

std::vector<std::uint32_t> traced(const Tracer& tracer, const std::vector<Ray>& rays, Query query) {
  std::vector<std::uint32_t> triangles(rays.size());
  TraceCounts counts;
  tracer.trace({.rays = rays, .query = query, .triangles = triangles}, counts);
  return triangles;
}

TEST(FastTracer, FindsWhatTestingEveryTriangleFinds) {
  Random random(seed);
  std::size_t hits = 0;
  std::size_t all = 0;
  for (const Mesh& mesh : meshes(random)) {
    const std::vector<Ray> rays = hard_rays(random, mesh, 1000);
    std::vector<std::uint32_t> right;
    for (const Ray& ray : rays) right.push_back(test_every_triangle(mesh, ray).triangle);
    all += rays.size();
    hits += rays.size() - static_cast<std::size_t>(std::count(right.begin(), right.end(), Hit::none));
    for (const BuildOptions& options :
         {BuildOptions{.builder = Builder::sah, .max_triangles = 4}, BuildOptions{.max_triangles = 1},
          BuildOptions{.max_triangles = 21}, BuildOptions{.max_triangles = 2, .padding = 0.0F}}) {
      const Bvh bvh = build_bvh(mesh, options);
      for (const VectorWidth width : widths()) {
        const auto tracer = fast_tracer(mesh, bvh, width);
        const auto closest = traced(*tracer, rays, Query::closest);
        const auto any = traced(*tracer, rays, Query::any);
        for (std::size_t i = 0; i < rays.size(); ++i) {
          ASSERT_EQ(closest[i], right[i])
              << adversary::to_text(rays[i]) << " vectors " << static_cast<int>(width);
          ASSERT_TRUE(same_answer(Query::any, any[i], right[i])) << adversary::to_text(rays[i]);
          if (any[i] == Hit::none) continue;
          Hit hit;
          ASSERT_TRUE(intersect_triangle(mesh, any[i], rays[i], hit)) << adversary::to_text(rays[i]);
        }
      }
    }
  }
  EXPECT_GT(hits, all / 4);
  EXPECT_LT(hits, all * 3 / 4);
}

TEST(FastTracer, ServesThreadsAndNeedsNoHierarchyOnceMade) {
  Random random(seed + 1);
  const Mesh mesh = hills(20);
  const std::vector<Ray> rays = hard_rays(random, mesh, 500);
  for (const VectorWidth width : widths()) {
    const auto tracer = fast_tracer(mesh, build_bvh(mesh), width);
    const auto right = traced(*make_tracer(mesh, build_bvh(mesh), {}), rays, Query::closest);
    std::vector<std::vector<std::uint32_t>> found(3);
    {
      std::vector<std::jthread> threads;
      for (auto& triangles : found)
        threads.emplace_back([&] { triangles = traced(*tracer, rays, Query::closest); });
    }
    for (const auto& triangles : found) EXPECT_EQ(triangles, right);
  }
}

TEST(FastTracer, CountsWhatItTests) {
  const Mesh mesh = hills(20);
  const auto tracer = fast_tracer(mesh, build_bvh(mesh), VectorWidth::four);
  EXPECT_EQ(tracer->bytes_per_node(), 128U);
  const std::vector<Ray> rays = coherent_rays({0.1F, 0.9F, 0.1F}, {0.2F, 0.0F, -0.3F}, 8);
  std::vector<std::uint32_t> triangles(rays.size());
  std::vector<TraceCounts> work(rays.size());
  TraceCounts counts;
  tracer->trace({rays, Query::closest, triangles, work}, counts);
  TraceCounts sum;
  for (const TraceCounts& each : work) sum += each;
  EXPECT_EQ(sum, counts);
  EXPECT_EQ(counts.rays, rays.size());
  EXPECT_LE(counts.box_tests, 4 * counts.nodes_loaded);
  EXPECT_GT(counts.box_tests, 2 * counts.nodes_loaded);
  EXPECT_GE(counts.triangle_tests, rays.size());
}

TEST(FastTracer, DeepestHierarchyFitsTheStack) {
  const Mesh mesh = one_triangle_a_level();
  const Bvh bvh = build_bvh(mesh, {.max_triangles = 1, .min_split = 0.0F});
  const std::vector<Ray> rays{{{0.95F, 0.0F, 0.0F}, {-1.0F, 0.0F, 0.0F}},
                              {{-0.95F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}}};
  for (const VectorWidth width : widths()) {
    for (std::size_t i = 0; i < rays.size(); ++i)
      EXPECT_EQ(traced(*fast_tracer(mesh, bvh, width), rays, Query::closest)[i],
                test_every_triangle(mesh, rays[i]).triangle);
  }
}

TEST(FastTracer, HasReasonsToRefuse) {
  const Mesh mesh = hills(2);
  EXPECT_EQ(message_of<std::invalid_argument>([&] { (void)fast_tracer(mesh, Bvh{}); }),
            "tracer: the hierarchy has no node; build it first");
  const auto tracer = fast_tracer(mesh, build_bvh(mesh));
  const std::vector<Ray> rays(2, Ray{{}, {1, 0, 0}});
  std::vector<std::uint32_t> triangles(1);
  TraceCounts counts;
  EXPECT_THROW(tracer->trace({rays, Query::closest, triangles}, counts), std::invalid_argument);
}

TEST(TriangleFilter, DiscardsOnlyWhatIsMissedAndMostOfIt) {
  Random random(seed + 2);
  std::size_t missed = 0;
  std::size_t discarded = 0;
  for (const Mesh& mesh : meshes(random)) {
    for (const Ray& ray : hard_rays(random, mesh, 1500)) {
      const TriangleFilter<FourLanes> filter(ray, 2);
      TrianglePack pack;
      for (std::size_t lane = 0; lane < TrianglePack::size; ++lane) {
        const auto triangle =
            static_cast<std::uint32_t>(below(random, static_cast<int>(mesh.triangles.size())));
        pack.set(lane, triangle, mesh.corners(triangle));
      }
      const unsigned may_hit = filter.may_hit(pack);
      for (std::size_t lane = 0; lane < TrianglePack::size; ++lane) {
        Hit hit;
        const bool hits = intersect_triangle(mesh, pack.triangles[lane], ray, hit);
        const bool discards = (may_hit >> lane & 1U) == 0;
        ASSERT_FALSE(hits && discards) << adversary::to_text(ray) << " triangle " << pack.triangles[lane];
        missed += hits ? 0 : 1;
        discarded += discards ? 1 : 0;
      }
    }
  }
  EXPECT_GT(discarded, missed * 3 / 5);
}

TEST(TriangleFilter, KeepsHitsWhereProductsUnderflow) {
  Random random(seed + 4);
  std::size_t hits = 0;
  for (int i = 0; i < 20'000; ++i) {
    Mesh mesh = i % 2 == 0 ? grid_soup(random, 1) : soup(random, 1);
    Ray ray = special_ray(random, mesh, i);
    const float scale = std::ldexp(1.0F, -40 - below(random, 25));
    for (glm::vec3& vertex : mesh.vertices) vertex *= scale;
    ray.origin *= scale;
    ray.direction *= std::ldexp(1.0F, -below(random, 60));
    if (ray.direction == glm::vec3(0.0F)) continue;
    ray.length = Ray::infinite;
    TrianglePack pack;
    pack.set(0, 0, mesh.corners(0));
    Hit hit;
    if (!intersect_triangle(mesh, 0, ray, hit)) continue;
    ++hits;
    ASSERT_TRUE((TriangleFilter<FourLanes>(ray, 2 * scale).may_hit(pack) & 1U) != 0)
        << adversary::to_text(ray);
  }
  EXPECT_GT(hits, 4'000U);
}

TEST(TriangleFilter, KeepsHitsWhereNumbersOverflow) {
  const float longest = std::numeric_limits<float>::max();
  const Ray ray{{-0.9F, -0.9F, -0.9F}, {longest, longest, longest}, Ray::infinite};
  Mesh mesh;
  add_triangle(mesh, {0.9F, 0.9F, 0.8F}, {0.8F, 0.9F, 0.9F}, {0.9F, 0.8F, 0.9F});
  Hit hit;
  ASSERT_TRUE(intersect_triangle(mesh, 0, ray, hit));
  TrianglePack pack;
  pack.set(0, 0, mesh.corners(0));
  EXPECT_NE(TriangleFilter<FourLanes>(ray, 2).may_hit(pack) & 1U, 0U);
}

/// Of nodes and triangles, in order.
struct Recorder final : LoadObserver {
  std::vector<std::uint32_t> nodes, triangles;
  void node_loaded(std::uint32_t index) override { nodes.push_back(index); }
  void triangle_loaded(std::uint32_t index) override { triangles.push_back(index); }
};

/// Tests one child after the other, as each is decoded.
template <class Store>
TraceCounts one_by_one(const Store& store, const Leaves& leaves, const Ray& ray, Query query, Hit& hit,
                       Recorder& recorder) {
  struct Waiting {
    BoxedChild child;
    float distance;
  };
  std::vector<Waiting> stack{{store.root(), 0}};
  std::array<BoxedChild, Store::width> children;
  ConservativeSlabs test(ray);
  TraceCounts counts{.rays = 1};
  float length = ray.length;
  while (!stack.empty()) {
    const Waiting at = stack.back();
    stack.pop_back();
    if (at.distance > length) continue;
    if (!at.child.is_branch()) {
      const auto triangles = leaves.triangles(at.child.first, at.child.count);
      const std::uint32_t before = hit.triangle;
      const std::uint32_t tests = leaves.test->ray(*leaves.mesh, triangles, ray, query, hit);
      Loads{&recorder}.triangles(triangles.first(tests));
      counts.triangle_tests += tests;
      counts.triangles_loaded += tests;
      if (hit.triangle == before) continue;
      if (query == Query::any) break;
      length = cull_length(hit);
      test.cut(length);
      continue;
    }
    recorder.node_loaded(at.child.first);
    ++counts.nodes_loaded;
    const unsigned count = store.children(at.child, children);
    counts.box_tests += count;
    std::vector<Waiting> entered;
    for (unsigned i = 0; i < count; ++i) {
      float distance = 0;
      if (test.enters(children[i].box, distance)) entered.push_back({children[i], distance});
    }
    std::stable_sort(entered.begin(), entered.end(),
                     [](const Waiting& a, const Waiting& b) { return a.distance < b.distance; });
    stack.insert(stack.end(), entered.rbegin(), entered.rend());
  }
  return counts;
}

template <class Stored>
void expect_same_loads(Encoding encoding) {
  Random random(seed + 3);
  for (const Mesh& mesh : meshes(random)) {
    const std::vector<Ray> rays = hard_rays(random, mesh, 500);
    for (const BuildOptions& options : {BuildOptions{}, surface_area_build}) {
      const Bvh bvh = build_bvh(mesh, options);
      const WideNodes<Stored> store(bvh);
      Leaves leaves(mesh, bvh);
      leaves.order = store.order();
      const auto tracer = make_tracer(mesh, bvh, {.algorithm = Algorithm::slabs_dist, .encoding = encoding});
      for (const Query query : {Query::closest, Query::any}) {
        for (const Ray& ray : rays) {
          Recorder expected, recorded;
          Hit hit;
          const TraceCounts counts = one_by_one(store, leaves, ray, query, hit, expected);
          std::uint32_t triangle = 0;
          TraceCounts together;
          tracer->trace({.rays = {&ray, 1}, .query = query, .triangles = {&triangle, 1}, .loads = &recorded},
                        together);
          ASSERT_EQ(together, counts) << adversary::to_text(ray);
          ASSERT_EQ(triangle, hit.triangle) << adversary::to_text(ray);
          ASSERT_EQ(recorded.nodes, expected.nodes) << adversary::to_text(ray);
          ASSERT_EQ(recorded.triangles, expected.triangles) << adversary::to_text(ray);
        }
      }
    }
  }
}

TEST(WideTracers, LoadWhatTheyLoadIfChildrenAreTestedOneByOne) {
  expect_same_loads<WideNode<4>>(Encoding::wide4);
  expect_same_loads<WideNode<8>>(Encoding::wide8);
  expect_same_loads<WideFloatNode<4>>(Encoding::wide4_float);
  expect_same_loads<WideFloatNode<8>>(Encoding::wide8_float);
}

}  // namespace
}  // namespace hitpipe::ref::fast_tracer_test
