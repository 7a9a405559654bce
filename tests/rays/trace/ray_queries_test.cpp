// All questions of the float world against every triangle by force: with vectors of four and of eight, on lattices with
// many ties, with stiff rays, and with coordinates at the ends of their range.
#include "rays/trace/ray_queries.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "rays/exact/float_crossing.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "tests/rays/exact/triangle_cases.hpp"
#include "tests/rays/trace/query_parts.hpp"
#include "tests/rays/world/tetrahedra.hpp"

namespace hitpipe::ref::ray_queries_test {
namespace {

using namespace query_parts;
using oracle::Rational;

constexpr unsigned seed = 71;
/// Every answer about one ray.
struct Answers {
  std::uint32_t nearest = Hit::none;
  std::optional<Rational> t{};  ///< of the nearest
  CrossingCount count{};
  std::vector<std::uint32_t> order{};  ///< all crossings
};

Answers by_force(const Mesh& mesh, const Ray& ray) {
  struct Found {
    Rational t;
    std::uint32_t triangle;
    bool operator<(const Found& other) const {
      return t != other.t ? t < other.t : triangle < other.triangle;
    }
  };
  std::vector<Found> hits, crossings;
  Answers made;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto found = float_crossing(mesh.corners(i), ray);
    if (!found) continue;
    hits.push_back({*cases::time_of_hit(mesh.corners(i), ray), i});
    made.count.ties += found->tie ? 1 : 0;
    if (!found->once) continue;
    crossings.push_back(hits.back());
    ++made.count.crossings;
    made.count.sides += found->side;
  }
  std::sort(crossings.begin(), crossings.end());
  for (const Found& each : crossings) made.order.push_back(each.triangle);
  if (hits.empty()) return made;
  const Found& first = *std::min_element(hits.begin(), hits.end());
  made.nearest = first.triangle;
  made.t = first.t;
  return made;
}

void expect_answers(const RayQueries& queries, const Mesh& mesh, const Ray& ray, const Answers& right) {
  const NearestHit hit = queries.nearest(ray, HitDetail::weights);
  ASSERT_EQ(hit.triangle, right.nearest);
  ASSERT_EQ(queries.nearest(ray, HitDetail::triangle).triangle, right.nearest);
  ASSERT_EQ(queries.nearest(ray, HitDetail::distance).t, hit.t);
  ASSERT_EQ(queries.any(ray), right.nearest != Hit::none);
  ASSERT_EQ(queries.count(ray), right.count);
  Crossings all(1);
  queries.all(ray, all);
  ASSERT_EQ(all.size(), right.order.size() + 1);
  for (std::size_t i = 0; i < right.order.size(); ++i) {
    ASSERT_EQ(all[i + 1].triangle, right.order[i]);
    const auto crossing = float_crossing(mesh.corners(right.order[i]), ray);
    ASSERT_EQ(all[i + 1].side, crossing->side);
    ASSERT_TRUE(is_floor(all[i + 1].t, *cases::time_of_hit(mesh.corners(right.order[i]), ray)));
  }
  if (right.nearest == Hit::none) {
    ASSERT_TRUE(std::isinf(hit.t));
    return;
  }
  ASSERT_TRUE(is_floor(hit.t, *right.t));
  double sum = 0;
  for (const double weight : hit.weights) {
    ASSERT_GE(weight, 0);
    sum += weight;
  }
  ASSERT_NEAR(sum, 1, 1e-15);
}

bool is_ray(const Ray& ray) {
  const glm::vec3& d = ray.direction;
  return d != glm::vec3(0) && std::isfinite(d.x) && std::isfinite(d.y) && std::isfinite(d.z);
}

/// Around another place, or in other units. Numbers of lattices stay exact where both are powers of two.
struct Place {
  float scale = 1;
  glm::vec3 at{0};
  float from_afar = 0;  ///< origins are moved back by so many directions

  [[nodiscard]] glm::vec3 operator()(const glm::vec3& v) const { return v * scale + at; }
  [[nodiscard]] Ray operator()(Ray ray) const {
    ray.origin = (*this)(ray.origin);
    ray.direction *= scale;
    if (from_afar > 0) {
      // The way back must not leave the range.
      const glm::vec3 d = glm::abs(ray.direction);
      const float longest = std::max({d.x, d.y, d.z});
      const float most = 0x1p24F / longest;
      ray.origin -= ray.direction * std::min(from_afar, most);
      ray.origin = glm::clamp(ray.origin, -0x1p24F, 0x1p24F);
    }
    return ray;
  }
};

void expect_all_by_force(const Mesh& given, const std::vector<Ray>& rays, const Place& place) {
  Mesh mesh = given;
  for (glm::vec3& vertex : mesh.vertices) vertex = place(vertex);
  Bvh bvhs[] = {build_bvh(mesh, {.builder = Builder::sah, .max_triangles = 4, .padding = 0, .min_split = 0}),
                build_bvh(mesh, {.max_triangles = 1})};
  std::vector<std::unique_ptr<RayQueries>> all;
  for (const VectorWidth width : widths())
    for (const Bvh& bvh : bvhs) all.push_back(float_queries(mesh, bvh, width));
  std::size_t hits = 0;
  for (const Ray& each : rays) {
    const Ray ray = place(each);
    if (!is_ray(ray)) continue;
    const Answers right = by_force(mesh, ray);
    hits += right.nearest != Hit::none ? 1 : 0;
    for (const auto& queries : all)
      ASSERT_NO_FATAL_FAILURE(expect_answers(*queries, mesh, ray, right)) << adversary::to_text(ray);
  }
  EXPECT_GT(hits, rays.size() / 20) << place.scale;
}

TEST(FloatQueries, AreWhatForceFinds) {
  Random random(seed);
  for (const Mesh& mesh : meshes(random))
    ASSERT_NO_FATAL_FAILURE(expect_all_by_force(mesh, hard_rays(random, mesh, 400), {}));
}

TEST(FloatQueries, AreExactAtTheEndsOfTheRange) {
  Random random(seed + 1);
  const float largest = 0x1p24F;
  for (const Place& place :
       {Place{largest}, Place{largest / 0.95F}, Place{1e-30F}, Place{0x1p-125F},
        Place{1, glm::vec3(largest * 0.99F, -7, 0.25F)}, Place{4096, glm::vec3(largest / 2)},
        Place{1, {}, 4000}, Place{1, {}, largest}, Place{largest, {}, 100}, Place{1e-6F, glm::vec3(1)}})
    for (const Mesh& mesh : {soup(random, 100), grid_soup(random, 60)})
      ASSERT_NO_FATAL_FAILURE(expect_all_by_force(mesh, hard_rays(random, mesh, 60), place)) << place.scale;
}

/// Tiny triangles, huge ones and rays from everywhere at once.
TEST(FloatQueries, MixSizes) {
  Random random(seed + 2);
  Mesh mesh;
  for (int i = 0; i < 120; ++i) {
    const auto place = [&] { return any_point(random) * std::ldexp(1.0F, 24 - below(random, 60)); };
    const glm::vec3 a = place();
    add_triangle(mesh, a, below(random, 2) == 0 ? -a : place(), place());
  }
  const Bvh bvh = build_bvh(mesh, {.max_triangles = 2, .padding = 0, .min_split = 0});
  std::size_t hits = 0;
  std::vector<Ray> rays = hard_rays(random, mesh, 600);
  for (Ray& ray : rays) {
    if (below(random, 2) == 0) {
      const glm::vec3 before = ray.origin;
      ray.origin = any_point(random) * std::ldexp(1.0F, 24 - below(random, 50));
      ray.direction += before - ray.origin;
    }
    if (!is_ray(ray)) continue;
    const Answers right = by_force(mesh, ray);
    hits += right.nearest != Hit::none ? 1 : 0;
    for (const VectorWidth width : widths())
      ASSERT_NO_FATAL_FAILURE(expect_answers(*float_queries(mesh, bvh, width), mesh, ray, right))
          << adversary::to_text(ray);
  }
  EXPECT_GT(hits, 200U);
}

TEST(FloatQueries, CrossClosedMeshesEvenly) {
  world_cases::Draw draw(seed);
  std::uint64_t ties = 0;
  for (int i = 0; i < 300; ++i) {
    const auto solid = tetrahedra::draw_solid(draw, 8);
    const IntMesh closed = tetrahedra::mesh_of(tetrahedra::oriented_boundary(solid), solid.bits);
    if (closed.triangles.empty()) continue;
    const Mesh& mesh = closed.mesh;
    const auto queries = float_queries(mesh, build_bvh(mesh));
    for (int k = 0; k < 20; ++k) {
      // From a place outside.
      const auto face = mesh.corners(
          static_cast<std::uint32_t>(draw.integer(0, static_cast<std::int64_t>(mesh.triangles.size()) - 1)));
      Ray ray{glm::vec3(0), {}, Ray::infinite};
      ray.origin[static_cast<int>(draw.integer(0, 2))] = draw.one_in(2) ? 1.5F : -3.0F;
      ray.direction = (draw.one_in(2) ? face.a : 0.5F * (face.a + face.b)) - ray.origin;
      const CrossingCount count = queries->count(ray);
      ASSERT_EQ(count.crossings % 2, 0U) << adversary::to_text(ray);
      ASSERT_EQ(count.sides, 0) << adversary::to_text(ray);
      ties += count.ties;
    }
  }
  EXPECT_GT(ties, 1'000U);
}

TEST(RayQueries, ServeThreads) {
  Random random(seed + 6);
  const Mesh mesh = hills(20);
  const IntMesh on_grid = int_mesh(mesh, 20);
  const Bvh bvh = build_bvh(on_grid.mesh);
  const std::vector<Ray> rays = hard_rays(random, mesh, 300);
  const auto floats = float_queries(mesh, build_bvh(mesh));
  const auto integers = int_queries(on_grid, &bvh, {20, 1, 20});
  for (const RayQueries* queries : {floats.get(), integers.get()}) {
    const auto answer = [&] {
      std::vector<double> answers;
      for (const Ray& ray : rays) {
        const NearestHit hit = queries->nearest(ray, HitDetail::weights);
        answers.insert(answers.end(), {hit.t, hit.weights[0], hit.weights[1], hit.weights[2]});
        Crossings all;
        queries->all(ray, all);
        for (const RayCrossing& each : all) answers.push_back(each.t);
        answers.push_back(static_cast<double>(queries->count(ray).ties));
      }
      return answers;
    };
    const std::vector<double> right = answer();
    std::vector<std::vector<double>> found(3);
    {
      std::vector<std::jthread> threads;
      for (auto& mine : found) threads.emplace_back([&] { mine = answer(); });
    }
    for (const auto& each : found) EXPECT_EQ(each, right);
  }
}

}  // namespace
}  // namespace hitpipe::ref::ray_queries_test
