// The traversal of the integer world against every triangle in rational arithmetic, with exact boxes and with
// those of int_major.
#include "rays/trace/int_tracer.hpp"

#include <ostream>
#include <vector>

#include <gtest/gtest.h>

#include "rays/trace/int_major.hpp"
#include "rays/trace/int_world.hpp"
#include "rays/world/int_boxes.hpp"
#include "rays/world/int_meets.hpp"
#include "sw_ref/trace/int_major_pair.hpp"
#include "tests/rays/world/cases.hpp"

namespace hitpipe::ref::int_tracer_test {
namespace {

using hls::MajorBits;
using hls::WorldBits;
using world_cases::Case;
using world_cases::Draw;
using world_cases::Rational;
using world_cases::truth;

/// Few bits make many ties, degenerate triangles and rays in faces.
Mesh random_mesh(Draw& draw, int triangles, const WorldBits& bits) {
  Mesh mesh;
  const auto most = static_cast<float>(bits.largest_corner());
  for (int i = 0; i < triangles; ++i) {
    const IntTriangle t = draw.triangle(bits);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const auto& corner : t.corners)
      mesh.vertices.emplace_back(static_cast<float>(corner[0]) / most, static_cast<float>(corner[1]) / most,
                                 static_cast<float>(corner[2]) / most);
    mesh.triangles.emplace_back(first, first + 1, first + 2);
  }
  return mesh;
}

/// A ray that the door makes again as it is.
Ray float_ray(const IntRay& ray, const WorldBits& bits) {
  Ray made;
  for (int axis = 0; axis < 3; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    made.origin[axis] =
        static_cast<float>(static_cast<double>(ray.origin[k]) / static_cast<double>(bits.largest_point()));
    made.direction[axis] = static_cast<float>(ray.direction[k]);
  }
  return made;
}

IntHit by_force(const IntMesh& mesh, const IntRay& ray, const WorldBits& bits) {
  IntHit best;
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    const auto exact = truth({bits, ray, mesh.triangles[i]});
    if (!exact) continue;
    const auto t = static_cast<std::int64_t>(oracle::floor(exact->distance * (1 << bits.fraction)));
    if (t <= ray.length) keep_better(t, i, best);
  }
  return best;
}

/// Two boxes at a time, as int_major_pair tests them.
IntHit by_pairs(const IntMesh& mesh, const Bvh& bvh, const IntRay& ray, const WorldBits& world,
                const MajorBits& bits, Query query) {
  const std::vector<PairBoxes> pairs = int_pairs(int_boxes(mesh.triangles, bvh), bvh);
  const MajorDistances distances(major_ray(ray, bits), bits);
  const BvhPairs records(bvh);
  const auto in_results = [&](std::int64_t length) { return in_box_units(length, world, bits); };
  IntRecordWalk walk(records, IntWorld(bvh, ray), query, in_results(ray.length));
  while (!walk.done()) {
    if (!walk.at_triangle()) {
      walk.answer(test_pair(distances, pairs[walk.record()], walk.parent()), in_results);
      continue;
    }
    const auto crossing = int_crossing(ray, mesh.triangles[walk.triangle()], world);
    walk.answer_triangle(crossing.has_value(), crossing ? crossing->t : 0, in_results);
  }
  return walk.hit();
}

TEST(IntTracer, FindsWhatForceFinds) {
  Draw draw(39021);
  int hits = 0;
  std::uint32_t dropped = 0;
  for (int scene = 0; scene < 40; ++scene) {
    const WorldBits bits{static_cast<int>(draw.integer(4, 10)), static_cast<int>(draw.integer(0, 2)),
                         static_cast<int>(draw.integer(2, 12)), static_cast<int>(draw.integer(0, 2))};
    const IntMesh mesh = int_mesh(random_mesh(draw, 24, bits), bits.coord);
    dropped += mesh.lost.triangles;
    if (mesh.triangles.empty()) continue;
    const Bvh bvh = build_bvh(mesh.mesh, {.max_triangles = 2, .padding = 0.0F});
    const auto exact = int_tracer(mesh, &bvh, {.world = bits});
    const MajorBits boxes{bits.coord, bits.finer, static_cast<int>(draw.integer(3, 11)), 0, bits.slope};
    ASSERT_TRUE(boxes.proved());
    const auto major = int_tracer(mesh, &bvh, {.world = bits, .boxes = boxes});
    for (int i = 0; i < 100; ++i) {
      const auto aim =
          static_cast<std::size_t>(draw.integer(0, static_cast<std::int64_t>(mesh.triangles.size()) - 1));
      const Ray ray = float_ray(draw.ray(bits, mesh.triangles[aim]), bits);
      const IntHit wanted = by_force(mesh, int_ray(ray, bits), bits);
      hits += wanted.found() ? 1 : 0;
      for (const Tracer* tracer : {exact.get(), major.get()}) {
        std::uint32_t closest = 0, any = 0;
        TraceCounts counts;
        tracer->trace({{&ray, 1}, Query::closest, {&closest, 1}}, counts);
        tracer->trace({{&ray, 1}, Query::any, {&any, 1}}, counts);
        ASSERT_EQ(closest, wanted.triangle) << "scene " << scene << ", ray " << i;
        ASSERT_EQ(any != IntHit::none, wanted.found());
      }
      const IntRay rounded = int_ray(ray, bits);
      ASSERT_EQ(by_pairs(mesh, bvh, rounded, bits, boxes, Query::closest).triangle, wanted.triangle);
      ASSERT_EQ(by_pairs(mesh, bvh, rounded, bits, boxes, Query::any).found(), wanted.found());
    }
  }
  EXPECT_GT(hits, 1'500);
  EXPECT_GT(dropped, 20U);
}

/// The traversal by int_major's boxes, with a fault in T or in the cut of the boxes.
struct Planted {
  const char* name;
  std::int64_t cut_less = 0;
  bool t_to_nearest = false;
};

void PrintTo(const Planted& fault, std::ostream* out) {
  *out << fault.name;
}

std::uint32_t walked(const IntMesh& mesh, const Bvh& bvh, const IntRay& ray, const WorldBits& world,
                     const MajorBits& bits, const Planted& fault) {
  const std::vector<IntBox> boxes = int_boxes(mesh.triangles, bvh);
  const MajorDistances distances(major_ray(ray, bits), bits);
  IntBoxWalk walk(bvh, IntWorld(bvh, ray), Query::closest);
  while (!walk.done()) {
    if (!walk.at_triangle()) {
      const std::int64_t cut = in_box_units(walk.length(), world, bits) - fault.cut_less;
      walk.answer(distances.meets(boxes[walk.node()], cut));
      continue;
    }
    const IntTriangle& triangle = mesh.triangles[walk.triangle()];
    const auto crossing = int_crossing(ray, triangle, world);
    std::int64_t t = crossing ? crossing->t : 0;
    if (crossing && fault.t_to_nearest) {
      const Rational twice = truth({world, ray, triangle})->distance * (2 << world.fraction);
      t = static_cast<std::int64_t>(oracle::floor((twice + 1) / 2));
    }
    walk.answer_triangle(crossing.has_value() && t <= ray.length, t);
  }
  return walk.hit().triangle;
}

class WalkFaults : public testing::TestWithParam<Planted> {};

TEST_P(WalkFaults, AreFound) {
  Draw draw(39024);
  int wrong = 0;
  for (int scene = 0; scene < 15; ++scene) {
    const WorldBits world{static_cast<int>(draw.integer(4, 10)), 1, static_cast<int>(draw.integer(4, 12)), 0};
    const MajorBits bits{world.coord, world.finer, 9, 0, world.slope};
    const IntMesh mesh = int_mesh(random_mesh(draw, 24, world), world.coord);
    if (mesh.triangles.empty()) continue;
    const Bvh bvh = build_bvh(mesh.mesh, {.max_triangles = 2, .padding = 0.0F});
    for (int i = 0; i < 100; ++i) {
      const auto aim =
          static_cast<std::size_t>(draw.integer(0, static_cast<std::int64_t>(mesh.triangles.size()) - 1));
      const IntRay ray = draw.ray(world, mesh.triangles[aim]);
      const IntHit wanted = by_force(mesh, ray, world);
      wrong += walked(mesh, bvh, ray, world, bits, GetParam()) == wanted.triangle ? 0 : 1;
    }
  }
  if (GetParam().cut_less == 0 && !GetParam().t_to_nearest) {
    EXPECT_EQ(wrong, 0);
  } else {
    EXPECT_GT(wrong, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Each, WalkFaults,
                         testing::Values(Planted{"nothing"}, Planted{"cut_one_too_small", 1},
                                         Planted{"t_to_nearest", 0, true}),
                         [](const auto& one) { return one.param.name; });

/// A ray that lies in a face of a box and never leaves it, as Needed.v has it.
TEST(MajorBoxes, HoldARayInTheirFace) {
  const WorldBits world{12, 1, 12, 0};
  const MajorBits bits{12, 1, 9, 0, 12};
  const IntBox box{{100, 5, -3}, {200, 5, 7}};
  for (const bool back : {false, true}) {
    const IntRay ray{.origin = {back ? 1000 : 0, 10, 0},
                     .direction = {back ? -(1 << 12) : 1 << 12, 0, 0},
                     .negative = {back, false, false},
                     .major = 0,
                     .length = world.largest_distance()};
    EXPECT_TRUE(int_meets(ray, box, ray.length, world));
    EXPECT_TRUE(MajorDistances(major_ray(ray, bits), bits).meets(box, in_box_units(ray.length, world, bits)));
    IntRay above = ray;
    above.origin[1] = 11;
    EXPECT_FALSE(int_meets(above, box, ray.length, world));
  }
}

TEST(MajorBoxes, NeverMissAnExactHit) {
  Draw draw(39022);
  int met = 0;
  for (int i = 0; i < 200'000; ++i) {
    const WorldBits world = draw.bits();
    const MajorBits bits{world.coord, world.finer, static_cast<int>(draw.integer(3, 13)),
                         static_cast<int>(draw.integer(-2, std::min(3, world.finer + world.fraction))),
                         world.slope};
    if (!bits.proved()) continue;
    const IntTriangle triangle = draw.triangle(world);
    const IntRay ray = draw.ray(world, triangle);
    IntBox box;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const auto [low, high] =
          std::minmax({triangle.corners[0][axis], triangle.corners[1][axis], triangle.corners[2][axis]});
      box.min[axis] = low;
      box.max[axis] = high;
    }
    const bool meets = int_meets(ray, box, ray.length, world);
    met += meets ? 1 : 0;
    const auto crossing = int_crossing(ray, triangle, world);
    const MajorDistances distances(major_ray(ray, bits), bits);
    const auto holds = [&](std::int64_t length) {
      return distances.meets(box, in_box_units(length, world, bits));
    };
    ASSERT_TRUE(!meets || holds(ray.length)) << i;
    ASSERT_TRUE(!crossing || (int_meets(ray, box, crossing->t, world) && holds(crossing->t))) << i;
  }
  EXPECT_GT(met, 50'000);
}

TEST(IntMesh, IsItsOwnRounding) {
  Draw draw(39023);
  for (const int n : {6, 12, 20, 24}) {
    const IntMesh once = int_mesh(random_mesh(draw, 200, {24, 0, 8, 0}), n);
    const IntMesh twice = int_mesh(once.mesh, n);
    EXPECT_EQ(twice.triangles, once.triangles);
    EXPECT_EQ(twice.lost.triangles, 0U);
    EXPECT_LE(once.largest_movement,
              0.5 / static_cast<double>(WorldBits{n, 0, 8, 0}.largest_corner()) + 1e-15);
  }
}

TEST(IntTracer, AnEmptyMeshIsNeverHit) {
  const IntMesh mesh = int_mesh(Mesh{}, 20);
  const auto tracer = int_tracer(mesh, nullptr, {});
  const Ray ray{{0, 0, 0}, {1, 0, 0}, Ray::infinite};
  std::uint32_t found = 0;
  TraceCounts counts;
  tracer->trace({{&ray, 1}, Query::closest, {&found, 1}}, counts);
  EXPECT_EQ(found, IntHit::none);
}

TEST(IntTracer, RefusesFormatsThatDoNotFit) {
  const IntMesh mesh = int_mesh(Mesh{}, 20);
  EXPECT_THROW((void)int_tracer(mesh, nullptr, {.world = {16, 1, 16, 0}}), std::invalid_argument);
  EXPECT_THROW((void)int_tracer(mesh, nullptr, {.boxes = MajorBits{20, 1, 11, 0, 16}}),
               std::invalid_argument);
  EXPECT_THROW((void)int_tracer(mesh, nullptr, {.boxes = MajorBits{20, 1, 11}}), std::invalid_argument);
  EXPECT_THROW((void)int_tracer(mesh, nullptr, {.boxes = MajorBits{20, 1, 11, 2, 20}}),
               std::invalid_argument);
  EXPECT_NO_THROW((void)int_tracer(mesh, nullptr, {.boxes = MajorBits{20, 1, 11, 1, 20}}));
}

}  // namespace
}  // namespace hitpipe::ref::int_tracer_test
