// All questions of the integer world against every triangle by force, in formats whose rays binary32 holds and in wider
// ones, and against MeshCrossings and int_tracer.
#include <algorithm>
#include <array>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "rays/trace/int_tracer.hpp"
#include "rays/trace/mesh_crossings.hpp"
#include "rays/trace/ray_queries.hpp"
#include "sw_ref/judge/adversary/case.hpp"
#include "tests/rays/trace/query_parts.hpp"
#include "tests/rays/world/tetrahedra.hpp"

namespace hitpipe::ref::int_queries_test {
namespace {

using namespace query_parts;
using hls::WorldBits;
using oracle::Rational;

constexpr unsigned seed = 71;
constexpr std::array<WorldBits, 7> formats{
    {{8, 0, 8}, {8, 1, 8}, {12, 1, 12}, {20, 1, 20}, {20, 2, 20, 4}, {24, 3, 32}, {24, 3, 20, 8}}};

struct IntAnswers {
  IntHit nearest;
  std::vector<MeshCrossing> crossings;
  CrossingCount count;
};

IntAnswers by_force(const IntMesh& mesh, const IntRay& ray, const WorldBits& bits) {
  IntAnswers made;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto found = crossing_of(ray, mesh.triangles[i], bits);
    if (!found) continue;
    keep_better(found->t, i, made.nearest);
    made.count.ties += found->tie ? 1 : 0;
    if (!found->once) continue;
    ++made.count.crossings;
    made.count.sides += found->side;
    made.crossings.push_back({{found->t, i}, found->side});
  }
  std::sort(made.crossings.begin(), made.crossings.end(),
            [](const MeshCrossing& a, const MeshCrossing& b) { return a.place < b.place; });
  return made;
}

void expect_answers(const RayQueries& queries, const IntMesh& mesh, const Ray& ray, const WorldBits& bits,
                    const IntAnswers& right) {
  const NearestHit hit = queries.nearest(ray, HitDetail::weights);
  ASSERT_EQ(hit.triangle, right.nearest.triangle);
  ASSERT_EQ(queries.nearest(ray, HitDetail::triangle).triangle, hit.triangle);
  ASSERT_EQ(queries.nearest(ray, HitDetail::distance).t, hit.t);
  ASSERT_EQ(queries.any(ray), right.nearest.found());
  ASSERT_EQ(queries.count(ray), right.count);
  Crossings all(1);
  queries.all(ray, all);
  ASSERT_EQ(all.size(), right.crossings.size() + 1);
  for (std::size_t i = 0; i < right.crossings.size(); ++i) {
    ASSERT_EQ(all[i + 1].triangle, right.crossings[i].place.triangle);
    ASSERT_EQ(all[i + 1].t, t_of_distance(right.crossings[i].place.t, ray, bits));
    ASSERT_EQ(all[i + 1].side, right.crossings[i].side);
  }
  if (!right.nearest.found()) return;
  ASSERT_EQ(hit.t, t_of_distance(right.nearest.t, ray, bits));
  const auto exact = int_crossing(int_ray(ray, bits), mesh.triangles[hit.triangle], bits);
  const auto integer = [](Int128 x) {
    return (oracle::Integer(static_cast<std::int64_t>(x >> 64)) << 64) + static_cast<std::uint64_t>(x);
  };
  for (std::size_t i = 0; i < 3; ++i)
    ASSERT_TRUE(is_floor(hit.weights[i], Rational(integer(exact->e[i]), integer(exact->det))));
}

/// Rays of the door, which hit corners and edges exactly, and rays that know nothing of the grid.
std::vector<Ray> int_rays(Random& random, world_cases::Draw& draw, const IntMesh& mesh, const WorldBits& bits,
                          int count) {
  std::vector<Ray> rays = hard_rays(random, mesh.mesh, count);
  for (int i = 0; i < count; ++i) {
    const auto exact = i % 2 == 0 ? tetrahedra::draw_ray(draw, bits, mesh.triangles)
                                  : std::optional(draw.ray(bits, draw.pick(mesh.triangles)));
    if (exact) rays.push_back(binary32_ray(*exact, bits));
  }
  return rays;
}

void expect_int_by_force(const IntMesh& mesh, const WorldBits& bits, std::vector<Ray> rays,
                         std::size_t& hits) {
  const Bvh bvh = build_bvh(mesh.mesh, {.max_triangles = 3, .padding = 0});
  const MeshCrossings crossings(mesh, &bvh, {.world = bits});
  const auto tracer = int_tracer(mesh, &bvh, {.world = bits});
  std::vector<std::unique_ptr<RayQueries>> all;
  for (const VectorWidth width : widths()) all.push_back(int_queries(mesh, &bvh, bits, width));
  for (std::size_t i = 0; i < rays.size(); ++i) {
    Ray& ray = rays[i];
    IntAnswers right = by_force(mesh, int_ray(ray, bits), bits);
    if (i % 5 == 0 && !right.crossings.empty()) {
      // It ends near a crossing.
      const auto& place = right.crossings[i % right.crossings.size()].place;
      ray.length = static_cast<float>(t_of_distance(place.t, ray, bits));
      right = by_force(mesh, int_ray(ray, bits), bits);
    }
    hits += right.nearest.found() ? 1 : 0;
    for (const auto& queries : all)
      ASSERT_NO_FATAL_FAILURE(expect_answers(*queries, mesh, ray, bits, right)) << adversary::to_text(ray);
    ASSERT_EQ(crossings.count(int_ray(ray, bits)), right.count);
    ASSERT_EQ(crossings.all(int_ray(ray, bits)).crossings, right.crossings);
    std::uint32_t traced = 0;
    TraceCounts counts;
    tracer->trace({{&ray, 1}, Query::closest, {&traced, 1}}, counts);
    ASSERT_EQ(traced, right.nearest.triangle);
  }
}

TEST(IntQueries, AreWhatForceFinds) {
  Random random(seed + 3);
  world_cases::Draw draw(seed + 3);
  std::size_t hits = 0;
  for (const WorldBits& bits : formats)
    for (const Mesh& mesh : meshes(random)) {
      const IntMesh on_grid = int_mesh(mesh, bits.coord);
      const auto rays = int_rays(random, draw, on_grid, bits, 200);
      ASSERT_NO_FATAL_FAILURE(expect_int_by_force(on_grid, bits, rays, hits))
          << bits.coord << '+' << bits.finer << 's' << bits.slope << 't' << bits.fraction;
    }
  EXPECT_GT(hits, 4'000U);
}

/// Small triangles near the ends of the grid, where rays of wide formats are rounded the most.
TEST(IntQueries, AllowForRaysThatBinary32DoesNotHold) {
  world_cases::Draw draw(seed + 4);
  std::size_t hits = 0;
  for (const WorldBits& bits :
       {WorldBits{24, 3, 32}, WorldBits{24, 3, 32, 8}, WorldBits{24, 0, 32}, WorldBits{24, 3, 8}})
    for (int scene = 0; scene < 150; ++scene) {
      const auto end = static_cast<std::int32_t>(bits.largest_corner());
      std::vector<IntTriangle> triangles(4);
      for (IntTriangle& triangle : triangles)
        for (auto& corner : triangle.corners)
          for (std::int32_t& x : corner)
            x = (scene % 2 == 0 ? end - static_cast<std::int32_t>(draw.integer(0, 3))
                                : static_cast<std::int32_t>(draw.integer(-2, 2)));
      const IntMesh mesh = tetrahedra::mesh_of(triangles, bits);
      if (mesh.triangles.empty()) continue;
      std::vector<Ray> rays;
      for (int i = 0; i < 60; ++i) {
        const auto ray = draw.ray(bits, draw.pick(mesh.triangles));
        rays.push_back(binary32_ray(ray, bits));
      }
      ASSERT_NO_FATAL_FAILURE(expect_int_by_force(mesh, bits, rays, hits));
    }
  EXPECT_GT(hits, 1'000U);
}

/// A ray nearly in the plane of a small triangle, which lies in a plane of axis x. Its origin has a digit more than
/// binary32, and without it the ray would pass far from the triangle.
TEST(IntQueries, AllowForOriginsBesideThoseOfBinary32) {
  const WorldBits bits{24, 3, 32};
  world_cases::Draw draw(seed + 7);
  const auto fraction = [&] { return static_cast<float>(draw.integer(0, 1 << 23)) * 0x1p-23F; };
  std::size_t hits = 0;
  for (int i = 0; i < 3'000; ++i) {
    const Ray ray{{0.5F + 0.4F * fraction(), -0.9F * fraction(), 0.2F * fraction()},
                  {std::ldexp(1 + fraction(), -static_cast<int>(draw.integer(20, 24))), 1, 0.3F * fraction()},
                  Ray::infinite};
    const IntRay rounded = int_ray(ray, bits);
    const std::int64_t plane = (rounded.origin[0] >> bits.finer) + 1;
    const std::int64_t way = (plane << bits.finer) - rounded.origin[0];
    const auto at = [&](std::size_t axis) {
      const Int128 along = static_cast<Int128>(way) * rounded.direction[axis] / rounded.direction[0];
      return (rounded.origin[axis] + static_cast<std::int64_t>(along)) >> bits.finer;
    };
    const std::int64_t y = at(1);
    const std::int64_t z = at(2);
    if (std::max(y, z) > bits.largest_corner() - 4) continue;
    const auto corner = [&](std::int64_t dy, std::int64_t dz) {
      return IntTriangle::Corner{static_cast<std::int32_t>(plane), static_cast<std::int32_t>(y + dy),
                                 static_cast<std::int32_t>(z + dz)};
    };
    const IntMesh mesh =
        tetrahedra::mesh_of({IntTriangle{{corner(-2, -2), corner(4, 0), corner(0, 4)}}}, bits);
    ASSERT_NO_FATAL_FAILURE(expect_int_by_force(mesh, bits, {ray}, hits));
  }
  EXPECT_GT(hits, 1'000U);
}

TEST(IntQueries, CrossClosedMeshesEvenly) {
  world_cases::Draw draw(seed + 5);
  std::uint64_t ties = 0;
  for (int i = 0; i < 600; ++i) {
    const auto solid = tetrahedra::draw_solid(draw, 8);
    const IntMesh mesh = tetrahedra::mesh_of(tetrahedra::oriented_boundary(solid), solid.bits);
    if (mesh.triangles.empty()) continue;
    const Bvh bvh = build_bvh(mesh.mesh);
    const auto queries = int_queries(mesh, &bvh, solid.bits);
    for (int k = 0; k < 20; ++k) {
      const auto line = tetrahedra::draw_ray(draw, solid.bits, mesh.triangles);
      if (!line) continue;
      const Ray ahead = binary32_ray(*line, solid.bits);
      const Ray behind{ahead.origin, -ahead.direction, Ray::infinite};
      const CrossingCount one = queries->count(ahead);
      const CrossingCount other = queries->count(behind);
      // What is at the origin itself counts in both.
      const CrossingCount twice = queries->count({ahead.origin, ahead.direction, 0});
      if (twice.ties + twice.crossings > 0) continue;
      ASSERT_EQ((one.crossings + other.crossings) % 2, 0U) << adversary::to_text(ahead);
      ties += one.ties + other.ties;
    }
  }
  EXPECT_GT(ties, 1'000U);
}

TEST(IntQueries, AnEmptyMeshHasNone) {
  const IntMesh mesh = int_mesh(Mesh{}, 20);
  const auto queries = int_queries(mesh, nullptr, {20, 1, 20});
  const Ray ray{{0, 0, 0}, {1, 0, 0}, Ray::infinite};
  EXPECT_EQ(queries->nearest(ray, HitDetail::weights).triangle, Hit::none);
  EXPECT_FALSE(queries->any(ray));
  EXPECT_EQ(queries->count(ray), CrossingCount{});
  Crossings all;
  queries->all(ray, all);
  EXPECT_TRUE(all.empty());
  EXPECT_THROW((void)int_queries(mesh, nullptr, {16, 1, 16}), std::invalid_argument);
  EXPECT_THROW((void)queries->any({{2, 0, 0}, {1, 0, 0}, 1}), std::out_of_range);
}

}  // namespace
}  // namespace hitpipe::ref::int_queries_test
