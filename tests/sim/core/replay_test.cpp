// Each verdict on a recorded answer, with triangles whose distances are known; and the right answers, compared with a
// test of every triangle.
#include "sim/core/replay.hpp"

#include <vector>

#include <gtest/gtest.h>

#include "rays/world/int_triangle.hpp"
#include "sw_ref/judge/adversary/random.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::sim::replay_test {
namespace {

using ref::Query;

constexpr hls::WorldBits world{12, 0, 12};
constexpr float unit = 1.0F / 1023;  ///< of the grid, in the cube

ref::IntScene scene_of(const std::vector<ref::IntTriangle>& triangles) {
  ref::Mesh mesh;
  for (const ref::IntTriangle& each : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.triangles.emplace_back(first, first + 1, first + 2);
    for (const auto& [x, y, z] : each.corners) mesh.vertices.push_back(glm::vec3(x, y, z) * unit);
  }
  return {.bits = world, .mesh = ref::int_mesh(mesh, world.coord), .scene = {}, .bvh = {}};
}

/// Seen from z = 500. 0 has no area, so the mesh lacks it. 1 and 2 share an edge over x = y, lie in two planes, and
/// differ in size. In that of 1, z is 3 (y + 100) / 200, in that of 3 it is (x + 100) / 200. 4 lies behind at z = -200.
const ref::IntScene scene = scene_of({{{{{0, 0, 0}, {0, 0, 0}, {1, 1, 1}}}},
                                      {{{{-100, -100, 0}, {100, -100, 0}, {100, 100, 3}}}},
                                      {{{{-100, -100, 0}, {100, 100, 3}, {-100, 0, 37}}}},
                                      {{{{-100, -120, 0}, {100, -120, 1}, {100, 120, 1}}}},
                                      {{{{-300, -300, -200}, {300, -300, -200}, {0, 300, -200}}}}});

AskedRay at(int x, int y) {
  return {.ray = {glm::vec3(x, y, 500) * unit, {0, 0, -1}}};
}
const AskedRay at_edge = at(0, 0);     ///< 1 and 2 at 498.5, 3 at 499.5
const AskedRay at_near = at(50, -60);  ///< 1 at 499.4, 3 at 499.25
const AskedRay at_far = at(-60, -80);  ///< 1 at 499.7, 3 at 499.8
const AskedRay beside = at(0, 600);

RightAnswer right_of(const AskedRay& asked) {
  return right_answers(scene, {&asked, 1}, 1).front();
}
Judgement judged(const AskedRay& asked, const RecordedAnswer& recorded, Query query = Query::closest) {
  return judge(scene, ref::int_ray(asked.ray, world), query, recorded, right_of(asked));
}
RecordedAnswer hit(std::uint32_t triangle, std::optional<std::int64_t> t = {}) {
  return {.triangle = triangle, .t = t};
}
constexpr RecordedAnswer miss{};

TEST(RightAnswers, AreTheLeastTAndThenTheLowestNumber) {
  for (const AskedRay* const asked : {&at_edge, &at_near, &at_far}) EXPECT_EQ(right_of(*asked).triangle, 1U);
  EXPECT_EQ(right_of(at_edge).t, 498);
  EXPECT_EQ(right_of(at_near).t, 499);
  EXPECT_EQ(right_of(at_far).t, 499);
  EXPECT_EQ(right_of(beside).triangle, std::nullopt);
}

TEST(RightAnswers, AreThoseOfATestOfEveryTriangle) {
  const ref::IntScene hills = ref::int_scene(sim::hills(), world);
  ref::adversary::Random random(5);
  const auto part = [&](float most) { return most * static_cast<float>(random.between(-1000, 1000)) / 1000; };
  std::vector<AskedRay> rays;
  for (int i = 0; i < 500; ++i)
    rays.push_back({.ray = {{part(1), part(1), part(1)},
                            {part(1), -1.5F, part(1)},
                            i % 3 == 0 ? 0.4F : ref::Ray::infinite},
                    .query = i % 2 == 0 ? Query::any : Query::closest});
  const std::vector<RightAnswer> right = right_answers(hills, rays, 2);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    ref::IntHit best;
    const ref::IntRay ray = ref::int_ray(rays[i].ray, world);
    for (std::uint32_t triangle = 0; triangle < hills.mesh.triangles.size(); ++triangle)
      if (const auto met = ref::int_crossing(ray, hills.mesh.triangles[triangle], world))
        keep_better(met->t, triangle, best);
    ASSERT_EQ(right[i].triangle.value_or(ref::IntHit::none), best.triangle) << i;
    ASSERT_EQ(right[i].t, best.t) << i;
    hits += best.found() ? 1 : 0;
  }
  EXPECT_GT(hits, 50);
  EXPECT_LT(hits, 400);
}

TEST(Verdict, IsSame) {
  const Judgement same{Verdict::same};
  EXPECT_EQ(judged(at_near, hit(1, 499)), same);
  EXPECT_EQ(judged(at_near, hit(1)), same) << "T was not recorded";
  EXPECT_EQ(judged(beside, miss), same);
  EXPECT_TRUE(same.good());
}

TEST(Verdict, IsAnExactTie) {
  const Judgement tie{Verdict::exact_tie};
  EXPECT_EQ(judged(at_edge, hit(2, 498)), tie) << "both at 498.5";
  EXPECT_EQ(judged(at_edge, hit(2)), tie);
  EXPECT_TRUE(tie.good());
}

TEST(Verdict, IsANearTie) {
  const Judgement tie{Verdict::near_tie};
  EXPECT_EQ(judged(at_near, hit(3, 499)), tie) << "a little nearer";
  EXPECT_EQ(judged(at_far, hit(3, 499)), tie) << "a little farther";
  EXPECT_EQ(judged(at_far, hit(3)), tie);
  EXPECT_FALSE(tie.good());
}

TEST(Verdict, IsNearer) {
  const Judgement nearer{Verdict::nearer};
  EXPECT_EQ(judged(at_near, hit(1, 498)), nearer);
  EXPECT_EQ(judged(at_near, hit(3, -1)), nearer);
  EXPECT_EQ(judged(at_near, hit(0, 498)), nearer) << "whatever the triangle";
  EXPECT_EQ(judged(beside, hit(1, 499)), nearer) << "no hit is right";
  EXPECT_EQ(judged(beside, hit(1, 499), Query::any), nearer);
  EXPECT_FALSE(nearer.good());
}

TEST(Verdict, IsFarther) {
  const Judgement farther{Verdict::farther};
  EXPECT_EQ(judged(at_near, hit(1, 500)), farther);
  EXPECT_EQ(judged(at_near, hit(4, 700)), farther);
  EXPECT_EQ(judged(at_near, hit(4)), farther) << "T of triangle 4";
  EXPECT_EQ(judged(at_edge, hit(3)), farther);
  EXPECT_EQ(judged(at_near, miss), farther);
  EXPECT_EQ(judged(at_near, miss, Query::any), farther);
  EXPECT_FALSE(farther.good());
}

TEST(Verdict, IsFailedForAReason) {
  const auto failed = [](std::string_view reason) { return Judgement{Verdict::failed, reason}; };
  EXPECT_EQ(judged(at_near, {.given = false}), failed("the record does not say why"));
  EXPECT_EQ(judged(beside, {.given = false, .failed = hls::no_ray}), failed("it is no ray"));
  const auto lacks = failed("the image has no triangle of that number");
  for (const std::uint32_t number : {0U, 5U, 0xffff'fffeU}) {
    EXPECT_EQ(judged(at_near, hit(number, 499)), lacks) << number;
    EXPECT_EQ(judged(at_near, hit(number)), lacks) << number;
    EXPECT_EQ(judged(at_near, hit(number), Query::any), lacks) << number;
  }
  const auto unmet = failed("the ray does not meet its triangle");
  EXPECT_EQ(judged(at_near, hit(2, 499)), unmet);
  EXPECT_EQ(judged(at_near, hit(2)), unmet);
  EXPECT_EQ(judged(at_near, hit(2), Query::any), unmet);
  EXPECT_EQ(judged(at_near, hit(4, 499)), failed("its triangle has another T"));
  EXPECT_FALSE(unmet.good());
}

TEST(Verdict, OfARayForAnyHitDoesNotLookAtT) {
  for (const std::uint32_t number : {1U, 3U, 4U})
    EXPECT_EQ(judged(at_near, hit(number, 3), Query::any), Judgement{Verdict::same}) << number;
}

/// Of a ray that ends before a triangle it is not met.
TEST(Verdict, KnowsWhereTheRayEnds) {
  AskedRay ends = at_near;
  ends.ray.length = 600 * unit;
  EXPECT_EQ(judged(ends, hit(4), Query::any).reason, "the ray does not meet its triangle");
  ends.ray.length = 100 * unit;
  EXPECT_EQ(judged(ends, hit(1, 499)).verdict, Verdict::nearer);
  EXPECT_EQ(judged(ends, miss).verdict, Verdict::same);
}

}  // namespace
}  // namespace hitpipe::sim::replay_test
