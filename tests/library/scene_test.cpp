// Scenes of the library: what they answer, what they refuse, and that no answer depends on threads or hierarchy.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hitpipe/scene.hpp>

#include "rays/exact/float_crossing.hpp"
#include "rays/image/core_image.hpp"
#include "rays/world/int_ray.hpp"
#include "rays/world/int_scene.hpp"
#include "tests/library/scenes.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::scene_test {
namespace {

using testing::ElementsAre;
using namespace scenes;  // NOLINT(google-build-using-namespace): what this file is about

TEST(Scene, AnswersEachQuestion) {
  // Through the cube; beside it; along an edge's middle, where two triangles meet; up to its middle.
  const std::vector<Ray> rays{{{-1, 0.25F, 0.5F}, {2, 0, 0}, endless},
                              {{-1, 2, 0.5F}, {2, 0, 0}, endless},
                              {{0.5F, 0.5F, -1}, {0, 0, 1}, endless},
                              {{-1, 0.25F, 0.5F}, {2, 0, 0}, 0.75F}};
  for (const char* world : worlds) {
    SCOPED_TRACE(world);
    // The integer world's cube is that of the rays here, so nothing is rounded but by its grid.
    const Transform as_it_is{{0, 0, 0}, 0.25};
    const bool floats = std::string(world) == "float";
    const Scene scene = cube().scene({.world = world, .transform = floats ? nullptr : &as_it_is});
    const SceneInfo info = scene.info();
    EXPECT_STREQ(info.world, world);
    EXPECT_EQ(info.triangles, 12U);
    EXPECT_EQ(info.without_area, 0U);
    EXPECT_TRUE(info.closed != 0 && info.oriented != 0 && info.odd_edges == 0);
    const double grid = floats ? 0 : 1e-4;

    const Nearest nearest = scene.nearest(rays);
    EXPECT_THAT(nearest.triangle, ElementsAre(8, no_triangle, testing::AnyOf(0, 1), 8));
    EXPECT_NEAR(nearest.t[0], 0.5, grid);
    EXPECT_EQ(nearest.t[1], std::numeric_limits<double>::infinity());
    EXPECT_NEAR(nearest.t[2], 1, grid);
    const std::array<double, 3> weights = nearest.weights[0];  // of (0, 0, 0), (0, 0, 1), (0, 1, 1)
    EXPECT_NEAR(weights[0], 0.5, grid);
    EXPECT_NEAR(weights[1], 0.25, grid);
    EXPECT_NEAR(weights[2], 0.25, grid);
    EXPECT_THAT(nearest.weights[1], ElementsAre(0, 0, 0));
    EXPECT_THAT(scene.any(rays), ElementsAre(1, 0, 1, 1));
    const Counts counts = scene.count(rays);
    EXPECT_THAT(counts.crossings, ElementsAre(2, 0, 2, 1));
    EXPECT_THAT(counts.sides, ElementsAre(0, 0, 0, -1));
    const Crossings all = scene.all(rays);
    EXPECT_THAT(all.offsets, ElementsAre(0, 2, 2, 4, 5));
    EXPECT_THAT(all.side, ElementsAre(-1, 1, -1, 1, -1));
    EXPECT_EQ(all.triangle[0], 8U);
    EXPECT_NEAR(all.t[1], 1, grid);

    const std::vector<Point> points{
        {0.5F, 0.5F, 0.5F}, {0.5F, 0.5F, 1.5F}, {0.25F, 0.75F, 0.125F}, {-0.5F, 0.5F, 0.5F}};
    EXPECT_THAT(scene.inside(points), ElementsAre(1, 0, 1, 0));
  }
}

TEST(Scene, FloatWorldIsTheExactTestOfEachTriangle) {
  const Shape shape = soup(300, 1);
  const Scene scene = shape.scene();
  ref::Mesh mesh;
  for (const Point& p : shape.corners) mesh.vertices.emplace_back(p[0], p[1], p[2]);
  for (const auto& [a, b, c] : shape.triangles) mesh.triangles.emplace_back(a, b, c);
  const std::vector<Ray> rays = random_rays(2'000, 2);
  const Nearest nearest = scene.nearest(rays);
  const std::vector<std::uint8_t> met = scene.any(rays);
  const Crossings all = scene.all(rays);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto& [o, d, length] = rays[i];
    const ref::Ray ray{{o[0], o[1], o[2]}, {d[0], d[1], d[2]}, length};
    ref::Hit hit;
    std::size_t crossings = 0;
    for (std::uint32_t k = 0; k < mesh.triangles.size(); ++k) {
      ref::intersect_triangle(mesh, k, ray, hit);
      const auto crossing = ref::float_crossing(mesh.corners(k), ray);
      crossings += crossing && crossing->once ? 1U : 0U;
    }
    ASSERT_EQ(nearest.triangle[i], hit.found() ? hit.triangle : no_triangle) << i;
    ASSERT_EQ(met[i], hit.found() ? 1 : 0) << i;
    ASSERT_EQ(all.offsets[i + 1] - all.offsets[i], crossings) << i;
    if (!hit.found()) continue;
    ++hits;
    const auto point = ref::plane_point(mesh.corners(hit.triangle), ray);
    ASSERT_EQ(nearest.t[i], point->t) << i;
    ASSERT_EQ(nearest.weights[i], point->weights) << i;
  }
  EXPECT_GT(hits, rays.size() / 5);
}

TEST(Scene, AnswersDependNeitherOnThreadsNorOnTheHierarchy) {
  const Shape shape = soup(500, 4);
  // Two leaves, in an order of their own.
  const Node nodes[] = {{1, 0}, {0, 200}, {200, 300}};
  std::vector<std::uint32_t> order(500);
  std::iota(order.rbegin(), order.rend(), 0U);
  const Transform as_it_is{{0, 0, 0}, 0.5};
  for (const char* world : worlds) {
    const Transform* const transform = std::string(world) == "float" ? nullptr : &as_it_is;
    const Scene scene = shape.scene({.world = world, .transform = transform, .threads = 1});
    const std::string right = all_answers(scene, 1);
    EXPECT_EQ(all_answers(scene, 7), right) << world;
    const Scene own =
        shape.scene({.world = world, .transform = transform, .nodes = nodes, .order = order, .threads = 7});
    EXPECT_EQ(all_answers(own, 7), right) << world;
  }
}

TEST(Scene, MovedIsANewSceneOfThesePlaces) {
  const Shape before = soup(200, 5);
  Shape after = soup(200, 6);
  after.triangles = before.triangles;
  const Transform as_it_is{{0, 0, 0}, 0.5};
  for (const char* world : worlds) {
    const Transform* const transform = std::string(world) == "float" ? nullptr : &as_it_is;
    Scene scene = before.scene({.world = world, .transform = transform});
    const std::string first = all_answers(scene, 2);
    scene.move(after.corners);
    EXPECT_EQ(all_answers(scene, 2), all_answers(after.scene({.world = world, .transform = transform}), 2))
        << world;
    auto bad = before.corners;
    bad[7][1] = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(message_of<Error>([&] { scene.move(bad); }), "corner 7: y = nan; allowed is -2^24 to 2^24");
    scene.move(before.corners);
    EXPECT_EQ(all_answers(scene, 2), first) << world;
  }
}

TEST(Scene, UnitsAreTheCallersAndLarge) {
  const Shape large = cube(0x1p24F);
  const std::vector<Ray> rays{{{-0x1p24F, 1, 2}, {0x1p20F, 0, 0}, endless},
                              {{0x1p23F, 1, 2}, {-1, 0, 0}, endless}};
  const Nearest nearest = large.scene().nearest(rays);
  EXPECT_THAT(nearest.triangle, ElementsAre(8, 8));
  EXPECT_THAT(nearest.t, ElementsAre(16, 0x1p23));
  const Shape tiny = cube(1e-30F);
  const std::vector<Ray> far{{{-1, 5e-31F, 2e-31F}, {1, 0, 0}, endless}};
  EXPECT_THAT(tiny.scene().count(far).crossings, ElementsAre(2));
}

TEST(Scene, WithoutTrianglesOrAreasNothingIsHit) {
  const std::vector<Ray> rays = random_rays(10, 7);
  for (const char* world : worlds) {
    const Transform as_it_is{{0, 0, 0}, 1};
    const SceneOptions options{.world = world,
                               .transform = std::string(world) == "float" ? nullptr : &as_it_is};
    const Scene empty({}, {}, options);
    EXPECT_THAT(empty.nearest(rays).triangle, testing::Each(no_triangle));
    EXPECT_THAT(empty.count(rays).crossings, testing::Each(0U));
    EXPECT_EQ(empty.info().closed, 1);
    const Shape line{{{0, 0, 0}, {0.5F, 0.5F, 0.5F}, {0.25F, 0.25F, 0.25F}}, {{0, 1, 2}, {0, 0, 0}}};
    const Scene flat = line.scene(options);
    EXPECT_EQ(flat.info().without_area, 2U);
    EXPECT_THAT(flat.any(rays), testing::Each(0));
  }
}

TEST(Scene, OfAnIntegerWorldServesAHostOfTheCore) {
  const Shape shape = soup(100, 8);
  const Transform transform{{0.125, 0, -0.25}, 0.5};
  const Scene scene = shape.scene({.world = "20+1s20", .transform = &transform});
  const std::vector<std::uint8_t> bytes = scene.core_image();
  const ref::CoreImage image =
      ref::checked_image(ref::core_image_blocks(std::string(bytes.begin(), bytes.end())));
  EXPECT_EQ(image.header.triangles + image.header.missing, 100U);
  EXPECT_EQ(image.header.coord_bits, 20);
  EXPECT_EQ(image.header.to_cube.scale, 0.5);
  EXPECT_EQ(image.header.to_cube.offset, glm::dvec3(0.125, 0, -0.25));

  const std::vector<Ray> rays = random_rays(1'000, 9);
  const std::vector<IntegerRay> integers = scene.integer_rays(rays);
  const Nearest nearest = scene.nearest(rays);
  const hls::WorldBits bits{.coord = 20, .finer = 1, .slope = 20};
  const ref::Normalisation moved{{0.125, 0, -0.25}, 0.5};
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto& [o, d, length] = rays[i];
    const glm::vec3 origin(moved.to_cube({o[0], o[1], o[2]}));
    const ref::IntRay right = ref::int_ray({origin, {d[0], d[1], d[2]}, length * 0.5F}, bits);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      ASSERT_EQ(integers[i].origin[axis], right.origin[axis]);
      ASSERT_EQ(integers[i].direction[axis], right.direction[axis]);
      ASSERT_EQ(integers[i].negative[axis] != 0, right.negative[axis]);
    }
    ASSERT_EQ(integers[i].major, right.major);
    ASSERT_EQ(integers[i].length, right.length);
    if (nearest.triangle[i] == no_triangle) continue;
    ++hits;
    // T of the core is whole, and t is that T in the caller's units.
    const double one = scene.own_distance(rays[i], 1);
    const double t = nearest.t[i] / one;
    ASSERT_NEAR(t, std::round(t), 1e-6);
    ASSERT_EQ(scene.own_distance(rays[i], static_cast<std::int64_t>(std::llround(t))), nearest.t[i]);
  }
  EXPECT_GT(hits, 100);
  EXPECT_EQ(message_of<Error>([&] { static_cast<void>(shape.scene().core_image()); }),
            "the scene is of the float world; a core's is of an integer one: \"20+1s20\"");
}

std::string refusal(const Shape& shape, const SceneOptions& options = {}) {
  return message_of<Error>([&] { static_cast<void>(shape.scene(options)); });
}

TEST(Scene, RefusesWhatIsNoMeshAndNoWorld) {
  Shape shape = cube();
  shape.corners[3][2] = endless;
  EXPECT_EQ(refusal(shape), "corner 3: z = inf; allowed is -2^24 to 2^24");
  shape = cube();
  shape.triangles[5][1] = 8;
  EXPECT_EQ(refusal(shape), "triangle 5: corner 8 of 8");
  for (const std::string world :
       {"99+1s20", "20+1s20b1c3", "20+1s20b1", "20+1s20c2", "20+1s20t9", "", "Float", "20"})
    EXPECT_EQ(refusal(cube(), {.world = world}),
              "world " + world +
                  ": allowed is \"float\", or n+gsS or n+gsStF with n in 8..24, g in 0..3, S in 8..32 and "
                  "F in 1..8, for example \"20+1s20\"");
  EXPECT_EQ(refusal(cube(), {.world = "20+1s20t8"}), "no exception");
  const Transform one{{0, 0, 0}, 1};
  EXPECT_EQ(refusal(cube(), {.transform = &one}),
            "transform: the float world has none; rays and corners are in your units");
  EXPECT_EQ(refusal(cube(2), {.world = "20+1s20", .transform = &one}),
            "corner 1: x is 2 in the cube of the integer world; allowed is [-1, 1]");
  EXPECT_EQ(refusal(cube(), {.threads = 257}), "257 threads; allowed are 1 to 256, or 0 for one a core");
  EXPECT_EQ(refusal(cube(0), {.world = "20+1s20"}),
            "all corners are in one place; an integer world needs a mesh with some extent");
}

TEST(Scene, RefusesAHierarchyThatIsNone) {
  const Shape shape = soup(4, 10);
  const auto why = [&](const std::vector<Node>& nodes, const std::vector<std::uint32_t>& order) {
    return refusal(shape, {.nodes = nodes, .order = order});
  };
  const std::vector<std::uint32_t> order{0, 1, 2, 3};
  EXPECT_EQ(why({{1, 0}, {0, 2}, {2, 2}}, order), "no exception");
  EXPECT_EQ(why({{1, 0}, {0, 2}, {2, 2}}, {0, 1, 2, 2}),
            "order of the hierarchy: triangle 2 is there twice; each of the 4 comes once");
  EXPECT_EQ(why({{1, 0}, {0, 2}, {2, 2}}, {0, 1, 2, 4}),
            "order of the hierarchy: triangle 4 is not in the mesh; each of the 4 comes once");
  EXPECT_EQ(why({{1, 0}, {0, 2}, {2, 3}}, order), "node 2: places 2 to 4 of an order of 4");
  EXPECT_EQ(why({{1, 0}, {0, 3}, {2, 2}}, order), "node 2: place 2 of the order is in another leaf, too");
  EXPECT_EQ(why({{1, 0}, {0, 2}, {2, 1}}, order), "the leaves have 3 triangles of 4");
  EXPECT_EQ(why({{2, 0}, {0, 2}, {2, 2}}, order),
            "node 0: children 2 and 3; they come after it and are below 3");
  EXPECT_EQ(why({{0, 0}, {0, 2}, {2, 2}}, order),
            "node 0: children 0 and 1; they come after it and are below 3");
  EXPECT_EQ(why({{0, 4}, {0, 2}}, order), "node 1: no branch before it has it as a child");
  EXPECT_EQ(why({{0, -1}}, order), "node 0: a leaf of -1 triangles");
  EXPECT_EQ(message_of<std::invalid_argument>([&] { static_cast<void>(shape.scene({.order = order})); }),
            "order of the hierarchy: it has no nodes; a hierarchy has both");
}

TEST(Scene, RefusesRaysAndNamesTheFirst) {
  const Transform one{{0, 0, 0}, 1};
  const Scene floats = cube().scene();
  const Scene integers = cube().scene({.world = "20+1s20", .transform = &one});
  const auto why = [](const Scene& scene, const Ray& bad, int threads) {
    std::vector<Ray> rays = random_rays(9'000, 11);
    rays[4'000] = rays[8'999] = bad;
    return message_of<Error>([&] { static_cast<void>(scene.any(rays, threads)); });
  };
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  for (const int threads : {1, 7}) {
    EXPECT_EQ(why(floats, {{0, nan, 0}, {1, 0, 0}, 1}, threads),
              "ray 4000: origin.y = nan; allowed is -2^24 to 2^24");
    EXPECT_EQ(why(floats, {{0, 0, 0}, {1, endless, 0}, 1}, threads),
              "ray 4000: direction.y = inf; components must be finite");
    EXPECT_EQ(why(floats, {{0, 0, 0}, {0, 0, 0}, 1}, threads),
              "ray 4000: direction is (0, 0, 0); one component must differ from 0");
    EXPECT_EQ(why(floats, {{0, 0, 0}, {1, 0, 0}, -1}, threads),
              "ray 4000: length = -1; it must be >= 0 or infinite");
    EXPECT_EQ(why(integers, {{0, 0, 2}, {1, 0, 0}, 1}, threads),
              "ray 4000: its origin is (0, 0, 2) in the cube of the integer world; allowed is [-1, 1]");
  }
}

TEST(Scene, OnlyAClosedMeshHasAnInside) {
  Shape open = cube();
  open.triangles.pop_back();
  const Scene scene = open.scene();
  EXPECT_EQ(scene.info().closed, 0);
  EXPECT_EQ(scene.info().odd_edges, 3U);
  const std::vector<Point> point{{0.5F, 0.5F, 0.5F}};
  EXPECT_EQ(message_of<Error>([&] { static_cast<void>(scene.inside(point)); }),
            "the mesh is not closed: 3 of its 18 edges have an odd number of triangles");
}

/// In C a null pointer is refused, places that are not wanted are left out, and short places get the offsets alone.
TEST(Scene, InC) {
  hitpipe_scene* scene = nullptr;
  EXPECT_EQ(hitpipe_scene_open(nullptr, nullptr, &scene), HITPIPE_BAD_ARGUMENT);
  EXPECT_STREQ(hitpipe_error(), "mesh: a null pointer is not allowed");
  EXPECT_EQ(scene, nullptr);
  const Shape shape = cube();
  const hitpipe_mesh mesh{shape.corners.front().data(), 8, shape.triangles.front().data(), 12};
  ASSERT_EQ(hitpipe_scene_open(&mesh, nullptr, &scene), HITPIPE_OK);
  const Ray ray{{-1, 0.25F, 0.5F}, {2, 0, 0}, endless};
  std::uint64_t offsets[2] = {7, 7};
  std::uint32_t triangle = 77;
  const hitpipe_all_out out{offsets, 1, &triangle, nullptr, nullptr};
  EXPECT_EQ(hitpipe_all(scene, &ray, 1, 1, &out), HITPIPE_OK);
  EXPECT_THAT(offsets, ElementsAre(0, 2));
  EXPECT_EQ(triangle, 77U);
  EXPECT_EQ(hitpipe_count(scene, &ray, 1, 1, nullptr, nullptr), HITPIPE_OK);
  const hitpipe_nearest_out nothing{};
  EXPECT_EQ(hitpipe_nearest(scene, &ray, 1, 1, &nothing), HITPIPE_OK);
  EXPECT_EQ(hitpipe_any(scene, &ray, 1, 1, nullptr), HITPIPE_BAD_ARGUMENT);
  EXPECT_EQ(hitpipe_any(scene, nullptr, 0, 1, nullptr), HITPIPE_OK);
  EXPECT_EQ(hitpipe_any(nullptr, &ray, 1, 1, nullptr), HITPIPE_BAD_ARGUMENT);
  hitpipe_scene_close(scene);
  hitpipe_scene_close(nullptr);
}

}  // namespace
}  // namespace hitpipe::scene_test
