// Scenes of instances: what they answer beside one mesh that has all triangles, where nothing is rounded; what a triangle
// of an answer is; masks, moves, refusals.
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hitpipe/scene.hpp>

#include "tests/library/scenes.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::scene_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using namespace scenes;  // NOLINT(google-build-using-namespace): what this file is about

// A unit is 2^17 of the grid, whose G is 2^18 - 1. So multiples of 2^-17 are on it.
const Transform on_grid{{0, 0, 0}, 131'072.0 / 262'143.0};

Matrix placed(std::array<double, 9> m, std::array<double, 3> move) {
  return {m[0], m[1], m[2], move[0], m[3], m[4], m[5], move[1], m[6], m[7], m[8], move[2]};
}
constexpr std::array<double, 9> unturned{1, 0, 0, 0, 1, 0, 0, 0, 1};
constexpr std::array<double, 9> turned{0, -1, 0, 1, 0, 0, 0, 0, 1};
constexpr std::array<double, 9> mirrored{-1, 0, 0, 0, 1, 0, 0, 0, 1};

Point moved(const Matrix& m, const Point& p) {
  Point to{};
  for (std::size_t k = 0; k < 3; ++k)
    to[k] = static_cast<float>(m[4 * k] * double{p[0]} + m[4 * k + 1] * double{p[1]} +
                               m[4 * k + 2] * double{p[2]} + m[4 * k + 3]);
  return to;
}

/// One mesh with all triangles; mirrored ones are turned.
Shape flattened(const std::vector<Shape>& shapes, const std::vector<Instance>& instances) {
  Shape all;
  for (const Instance& instance : instances) {
    Matrix m{};
    std::copy(std::begin(instance.matrix), std::end(instance.matrix), m.begin());
    const double det = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
                       m[2] * (m[4] * m[9] - m[5] * m[8]);
    const auto first = static_cast<std::uint32_t>(all.corners.size());
    for (const Point& p : shapes[instance.mesh].corners) all.corners.push_back(moved(m, p));
    for (auto [a, b, c] : shapes[instance.mesh].triangles) {
      if (det < 0) std::swap(b, c);
      all.triangles.push_back({first + a, first + b, first + c});
    }
  }
  return all;
}

Instance instance_of(std::uint32_t mesh, const Matrix& matrix, std::uint32_t number = 0,
                     std::uint8_t mask = 0xff) {
  Instance made{mesh, number, {}, mask};
  std::copy(matrix.begin(), matrix.end(), made.matrix);
  return made;
}

std::vector<InstanceMesh> meshes_of(const std::vector<Shape>& shapes) {
  std::vector<InstanceMesh> meshes;
  for (const Shape& shape : shapes) meshes.push_back({shape.corners, shape.triangles});
  return meshes;
}

void expect_same_answers(const Scene& one, const Scene& other, const std::vector<Ray>& rays) {
  const Nearest a = one.nearest(rays);
  const Nearest b = other.nearest(rays);
  ASSERT_EQ(a.triangle, b.triangle);
  ASSERT_EQ(a.t, b.t);
  ASSERT_EQ(a.weights, b.weights);
  ASSERT_EQ(one.any(rays), other.any(rays));
  ASSERT_EQ(one.count(rays).crossings, other.count(rays).crossings);
  ASSERT_EQ(one.count(rays).sides, other.count(rays).sides);
  const Crossings c = one.all(rays);
  const Crossings d = other.all(rays);
  ASSERT_EQ(c.triangle, d.triangle);
  ASSERT_EQ(c.t, d.t);
  ASSERT_EQ(c.side, d.side);
}

/// Corners on a grid of 2^-6, so that nothing is rounded where they are turned and moved by that.
Shape coarse(Shape shape) {
  for (Point& p : shape.corners)
    for (float& x : p) x = std::round(x * 16) / 64;
  return shape;
}

class Pieces {
 public:
  explicit Pieces(unsigned seed) : random_(seed) {}
  Matrix matrix() {
    constexpr std::array ways{unturned, turned, mirrored};
    std::array<double, 9> m = ways[random_() % 3];
    const double scale = random_() % 2 == 0 ? 1 : 0.5;
    for (double& x : m) x *= scale;
    std::array<double, 3> move{};
    for (double& x : move) x = (static_cast<double>(random_() % 97) - 48) / 64;
    return placed(m, move);
  }

 private:
  std::mt19937 random_;
};

TEST(SceneOfInstances, AnswersAsOneMesh) {
  const std::vector<Shape> shapes{coarse(soup(40, 3)), coarse(cube())};
  Pieces pieces(4);
  std::vector<Instance> instances;
  for (std::uint32_t i = 0; i < 40; ++i) instances.push_back(instance_of(i % 2, pieces.matrix(), 1000 + i));
  const SceneOptions options{.world = "20+1s20", .transform = &on_grid};
  Scene scene = Scene::of_instances(meshes_of(shapes), instances, options);
  const std::vector<Ray> rays = random_rays(3'000, 5);
  expect_same_answers(scene, flattened(shapes, instances).scene(options), rays);
  EXPECT_EQ(scene.info().triangles, 20U * (40 + 12));

  // One that moves, and all.
  for (const std::size_t first : {7U, 0U}) {
    std::vector<Matrix> matrices(first == 0 ? instances.size() : 1);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      matrices[i] = pieces.matrix();
      std::copy(matrices[i].begin(), matrices[i].end(), instances[first + i].matrix);
    }
    scene.place(first, matrices);
    expect_same_answers(scene, flattened(shapes, instances).scene(options), rays);
  }

  // If one is refused, none has moved.
  std::vector<Matrix> matrices(instances.size());
  for (Matrix& matrix : matrices) matrix = pieces.matrix();
  matrices.back() = placed(unturned, {9, 0, 0});
  EXPECT_THAT(message_of([&] { scene.place(0, matrices); }), HasSubstr("instance 39: "));
  expect_same_answers(scene, flattened(shapes, instances).scene(options), rays);

  const Nearest nearest = scene.nearest(rays);
  const std::vector<Part> parts = scene.parts(nearest.triangle);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (nearest.triangle[i] == no_triangle) {
      ASSERT_EQ(parts[i].instance, no_triangle);
      continue;
    }
    ++hits;
    ASSERT_EQ(parts[i].mesh, parts[i].instance % 2);
    ASSERT_EQ(parts[i].number, 1000 + parts[i].instance);
    ASSERT_EQ(parts[i].instance / 2 * 52 + parts[i].instance % 2 * 40 + parts[i].triangle,
              nearest.triangle[i]);
  }
  EXPECT_GT(hits, 300U);
}

TEST(SceneOfInstances, RaysSeeWhatHasABitOfTheirMask) {
  const Shape shape = coarse(cube());
  std::vector<Instance> instances;
  for (const int i : {0, 1, 2})
    instances.push_back(
        instance_of(0, placed(unturned, {0, 0, i * 0.5}), 0, static_cast<std::uint8_t>(1U << i)));
  Scene scene =
      Scene::of_instances(meshes_of({shape}), instances, {.world = "20+1s20", .transform = &on_grid});
  const std::vector<Ray> up{{{0.1F, 0.05F, -1}, {0, 0, 1}, endless}};
  EXPECT_EQ(scene.count(up).crossings[0], 6U);
  const Scene second = scene.masked(2);
  EXPECT_EQ(second.count(up).crossings[0], 2U);
  EXPECT_EQ(scene.parts(second.nearest(up).triangle)[0].instance, 1U);
  EXPECT_EQ(scene.masked(0).any(up)[0], 0);
  // What one moves, all have moved.
  scene.place(1, std::vector<Matrix>{placed(unturned, {1, 0, 0})});
  EXPECT_EQ(second.any(up)[0], 0);
}

TEST(SceneOfInstances, ClosedIfEachMeshIs) {
  const std::vector<Instance> two{instance_of(0, placed(turned, {0, 0, 0})),
                                  instance_of(0, placed(mirrored, {1, 0, 0}))};
  const Scene closed =
      Scene::of_instances(meshes_of({coarse(cube())}), two, {.world = "20+1s20", .transform = &on_grid});
  EXPECT_EQ(closed.info().closed, 1);
  EXPECT_EQ(closed.info().oriented, 1);
  EXPECT_THAT(closed.inside(std::vector<Point>{{-0.1F, 0.1F, 0.1F}, {0.5F, 0.1F, 0.1F}, {0.9F, 0.1F, 0.1F}}),
              ElementsAre(1, 0, 1));
  Shape open = cube();
  open.triangles.pop_back();
  const Scene gap =
      Scene::of_instances(meshes_of({coarse(open)}), two, {.world = "20+1s20", .transform = &on_grid});
  EXPECT_EQ(gap.info().closed, 0);
  EXPECT_EQ(gap.info().odd_edges, 6U);
}

TEST(SceneOfInstances, RefusesInOneLine) {
  const std::vector<Shape> shapes{cube()};
  const auto refused = [&](std::vector<Instance> instances, const SceneOptions& options) {
    return message_of(
        [&] { const Scene scene = Scene::of_instances(meshes_of(shapes), instances, options); });
  };
  const Instance one = instance_of(0, placed(unturned, {0, 0, 0}));
  EXPECT_THAT(refused({one}, {}), HasSubstr("instances are of an integer world"));
  EXPECT_THAT(refused({one, instance_of(1, placed(unturned, {}))}, {.world = "20+1s20"}),
              HasSubstr("instance 1: mesh 1; there are 1"));
  EXPECT_THAT(
      refused({one, one, instance_of(0, placed(unturned, {std::numeric_limits<double>::quiet_NaN(), 0, 0}))},
              {.world = "20+1s20"}),
      HasSubstr("instance 2: matrix[3] = nan"));
  EXPECT_THAT(refused({one, instance_of(0, placed(unturned, {3, 0, 0}))},
                      {.world = "20+1s20", .transform = &on_grid}),
              HasSubstr("instance 1: "));
  Scene scene = Scene::of_instances(meshes_of(shapes), std::vector<Instance>{one},
                                    {.world = "20+1s20", .transform = &on_grid});
  EXPECT_THAT(message_of([&] { scene.place(1, std::vector<Matrix>(1)); }), HasSubstr("the scene has 1"));
  EXPECT_THAT(message_of([&] {
                scene.place(0, std::vector<Matrix>{placed(unturned, {9, 0, 0})});
              }),
              HasSubstr("instance 0: "));
  EXPECT_THAT(message_of([&] { (void)scene.core_image(); }), HasSubstr("instances"));
  EXPECT_THAT(message_of([&] { (void)scene.parts(std::vector<std::uint32_t>{12}); }),
              HasSubstr("triangle 0 is 12"));
  EXPECT_THAT(message_of([&] { (void)cube().scene().masked(1); }), HasSubstr("no instances"));
  const std::vector<Ray> rays{{{0.5F, 0.5F, -1}, {0, 0, 1}, endless}};
  EXPECT_EQ(scene.count(rays).crossings[0], 2U);
}

TEST(SceneOfInstances, FlattenedToAShadowAndTurnedByAnyAngle) {
  const Shape shape = cube();
  const double c = std::cos(0.7), s = std::sin(0.7);
  const std::vector<Instance> instances{instance_of(0, placed({1, 0, 0, 0, 1, 0, 0, 0, 0}, {0, 0, -1})),
                                        instance_of(0, placed({c, -s, 0, s, c, 0, 0, 0, 1}, {0, 0, 0}))};
  const Scene scene = Scene::of_instances(meshes_of({shape}), instances, {.world = "20+1s20"});
  // The solid is crossed twice. Of the shadow its top and its bottom are, at one place.
  const Counts counts = scene.count(std::vector<Ray>{{{0.1F, 0.5F, 0.9F}, {0, 0, -1}, endless}});
  EXPECT_EQ(counts.crossings[0], 3U);
  EXPECT_EQ(counts.sides[0], 1);
}

}  // namespace
}  // namespace hitpipe::scene_test
