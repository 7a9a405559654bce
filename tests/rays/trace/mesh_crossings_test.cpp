// Questions about all crossings of a ray with a mesh, against every triangle by force, with exact boxes and with
// those of int_major.
#include "rays/trace/mesh_crossings.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "sw_ref/render/camera.hpp"
#include "sw_ref/world/crossing_picture.hpp"
#include "tests/rays/world/tetrahedra.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::ref::mesh_crossings_test {
namespace {

using hls::MajorBits;
using hls::WorldBits;
using tetrahedra::mesh_of;
using tetrahedra::Solid;
using world_cases::Draw;

struct Forced {
  CrossingCount count;
  std::vector<MeshCrossing> all;
};

Forced by_force(const IntMesh& mesh, const IntRay& ray, const WorldBits& bits) {
  Forced made;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto found = crossing_of(ray, mesh.triangles[i], bits);
    if (!found) continue;
    made.count.ties += found->tie ? 1 : 0;
    if (!found->once) continue;
    ++made.count.crossings;
    made.count.sides += found->side;
    made.all.push_back({{found->t, i}, found->side});
  }
  std::sort(made.all.begin(), made.all.end(),
            [](const MeshCrossing& a, const MeshCrossing& b) { return a.place < b.place; });
  return made;
}

TEST(MeshCrossings, AreThoseOfForce) {
  Draw draw(39121);
  std::uint64_t crossed = 0, ties = 0, equal_t = 0;
  for (int scene = 0; scene < 3'000; ++scene) {
    const Solid solid = tetrahedra::draw_solid(draw, 12);
    // Triangles that are there more than once make crossings of equal T.
    const auto faces = scene % 2 == 0 ? tetrahedra::boundary(solid) : tetrahedra::oriented_boundary(solid);
    const WorldBits& bits = solid.bits;
    const IntMesh mesh = mesh_of(faces, bits);
    if (mesh.triangles.empty()) continue;
    const Bvh bvh = build_bvh(mesh.mesh, {.max_triangles = 2, .padding = 0.0F});
    const MeshCrossings exact(mesh, &bvh, {.world = bits});
    const MajorBits boxes{bits.coord, bits.finer, static_cast<int>(draw.integer(4, 11)), 0, bits.slope};
    const MeshCrossings major(mesh, &bvh, {.world = bits, .boxes = boxes});
    for (int i = 0; i < 12; ++i) {
      auto ray = tetrahedra::draw_ray(draw, bits, mesh.triangles);
      if (!ray) continue;
      const Forced endless = by_force(mesh, *ray, bits);
      // A length at a crossing or one less.
      if (!endless.all.empty() && draw.one_in(3))
        ray->length = std::max<std::int64_t>(0, draw.pick(endless.all).place.t - draw.integer(0, 1));
      const Forced wanted = by_force(mesh, *ray, bits);
      for (const MeshCrossings* each : {&exact, &major}) {
        ASSERT_EQ(each->count(*ray), wanted.count) << "scene " << scene << ", ray " << i;
        const CrossingList all = each->all(*ray);
        ASSERT_EQ(all.crossings, wanted.all) << "scene " << scene << ", ray " << i;
        ASSERT_EQ(all.count, wanted.count) << "scene " << scene << ", ray " << i;
        std::vector<MeshCrossing> walked;
        for (auto next = each->next(*ray); next; next = each->next(*ray, next->place)) {
          walked.push_back(*next);
          ASSERT_LE(walked.size(), wanted.all.size());
        }
        ASSERT_EQ(walked, wanted.all) << "scene " << scene << ", ray " << i;
      }
      crossed += wanted.count.crossings;
      ties += wanted.count.ties;
      for (std::size_t k = 1; k < wanted.all.size(); ++k)
        equal_t += wanted.all[k].place.t == wanted.all[k - 1].place.t ? 1 : 0;
    }
  }
  EXPECT_GT(crossed, 10'000U);
  EXPECT_GT(ties, 5'000U);
  EXPECT_GT(equal_t, 500U);
}

TEST(MeshCrossings, SayWhetherAPlaceIsInside) {
  Draw draw(39203);
  int inside = 0, outside = 0, at_the_mesh = 0;
  for (int i = 0; i < 3'000; ++i) {
    const tetrahedra::Solid solid = tetrahedra::draw_solid(draw, 8);
    const IntMesh mesh = mesh_of(tetrahedra::boundary(solid), solid.bits);
    if (mesh.triangles.empty()) continue;
    const Bvh bvh = build_bvh(mesh.mesh, {.max_triangles = 2, .padding = 0.0F});
    const MeshCrossings crossings(mesh, &bvh, {.world = solid.bits});
    for (int k = 0; k < 8; ++k) {
      tetrahedra::Point place{};
      const auto& corner = draw.pick(draw.pick(mesh.triangles).corners);
      for (std::size_t axis = 0; axis < 3; ++axis)
        place[axis] = std::clamp((std::int64_t{corner[axis]} << solid.bits.finer) + draw.integer(-5, 5),
                                 -solid.bits.largest_point(), solid.bits.largest_point());
      const std::optional<bool> found = crossings.is_inside(place), wanted = tetrahedra::inside(solid, place);
      if (found) {
        // A face that two tetrahedra share is not in the mesh.
        ASSERT_EQ(*found, wanted.value_or(*found));
        ++(*found ? inside : outside);
      }
      at_the_mesh += found ? 0 : 1;
    }
  }
  EXPECT_GT(inside, 500);
  EXPECT_GT(outside, 2'000);
  EXPECT_GT(at_the_mesh, 500);
}

/// A place need not be that of a crossing.
TEST(MeshCrossings, NextIsBehindAnyPlace) {
  const WorldBits bits{12, 1, 12, 0};
  const auto at = [](std::int32_t x) { return IntTriangle{{{{x, 0, 0}, {x, 8, 0}, {x, 0, 8}}}}; };
  const IntMesh mesh = mesh_of({at(20), at(10), at(10), at(-10)}, bits);
  const Bvh bvh = build_bvh(mesh.mesh, {.max_triangles = 1, .padding = 0.0F});
  const MeshCrossings crossings(mesh, &bvh, {.world = bits});
  const IntRay ray = Draw::along(bits, {0, 2, 2}, {1, 0, 0});
  const auto behind = [&](std::int64_t t, std::uint32_t triangle) {
    const auto found = crossings.next(ray, {t, triangle});
    return found ? static_cast<int>(found->place.triangle) : -1;
  };
  EXPECT_EQ(crossings.next(ray)->place, (CrossingPlace{20, 1}));
  EXPECT_EQ(behind(19, 3), 1);
  EXPECT_EQ(behind(20, 0), 1);
  EXPECT_EQ(behind(20, 1), 2);
  EXPECT_EQ(behind(20, 2), 0);
  EXPECT_EQ(behind(39, 0), 0);
  EXPECT_EQ(behind(40, 0), -1);
  EXPECT_EQ(crossings.count(ray), (CrossingCount{3, 3, 0}));
  EXPECT_TRUE(crossings.count(ray).inside());
}

TEST(MeshCrossings, AnEmptyMeshHasNone) {
  const IntMesh mesh = int_mesh(Mesh{}, 20);
  const MeshCrossings crossings(mesh, nullptr, {});
  const IntRay ray = Draw::along({}, {0, 0, 0}, {1, 0, 0});
  EXPECT_EQ(crossings.count(ray), CrossingCount{});
  EXPECT_FALSE(crossings.next(ray));
  EXPECT_TRUE(crossings.all(ray).crossings.empty());
}

TEST(MeshCrossings, FormatsThatDoNotFitRejected) {
  const IntMesh mesh = int_mesh(Mesh{}, 20);
  EXPECT_THROW(MeshCrossings(mesh, nullptr, {.world = {16, 1, 16, 0}}), std::invalid_argument);
  EXPECT_THROW(MeshCrossings(mesh, nullptr, {.boxes = MajorBits{20, 1, 11, 0, 16}}), std::invalid_argument);
}

TEST(CrossingPicture, IsTheCountOfEachRay) {
  const IntScene scene = int_scene(sim::hills(), {20, 1, 20, 0});
  const MeshCrossings crossings(scene.mesh, scene.hierarchy(), {.world = scene.bits});
  const CrossingPicture picture = crossing_picture(scene, crossings, 24, 16, 2);
  ASSERT_EQ(picture.counts.size(), 24U * 16U);
  std::uint64_t sum = 0, most = 0, odd = 0;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 24; ++x) {
      const Ray ray = primary_ray(scene.scene.camera, x, y, 24, 16);
      const Forced wanted = by_force(scene.mesh, int_ray(ray, scene.bits), scene.bits);
      const std::uint64_t count = wanted.count.crossings;
      ASSERT_EQ(picture.counts[static_cast<std::size_t>(y * 24 + x)], static_cast<float>(count));
      sum += count;
      most = std::max(most, count);
      odd += count % 2;
    }
  EXPECT_GT(sum, 100U);
  EXPECT_EQ(picture.crossings, sum);
  EXPECT_EQ(picture.most, most);
  EXPECT_EQ(picture.odd_rays, odd);
}

}  // namespace
}  // namespace hitpipe::ref::mesh_crossings_test
