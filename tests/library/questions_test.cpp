// Questions where solids overlap, and while a scene moves.
#include <atomic>
#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/library/scenes.hpp"

namespace hitpipe::questions_test {
namespace {

using namespace scenes;  // NOLINT(google-build-using-namespace): what this file is about
using testing::ElementsAre;

/// Adds a cube from `low` to `low` + side on each axis; `turned`: its triangles are clockwise from outside.
void add_cube(Shape& shape, float low, float side, bool turned = false) {
  const auto first = static_cast<std::uint32_t>(shape.corners.size());
  const Shape own = cube(side);
  for (const Point& p : own.corners) shape.corners.push_back({low + p[0], low + p[1], low + p[2]});
  for (const auto& [a, b, c] : own.triangles)
    shape.triangles.push_back(turned ? TriangleCorners{first + a, first + c, first + b}
                                     : TriangleCorners{first + a, first + b, first + c});
}

TEST(Inside, IsTheEvenOddRuleAndSidesAreTheWindingNumber) {
  struct Case {
    std::vector<std::tuple<float, float, bool>> cubes;
    std::array<int, 5> windings;  ///< of the points below
  };
  const std::vector<Point> points{
      {0.25F, 0.3F, 0.2F}, {1.5F, 1.4F, 1.3F}, {2.5F, 2.6F, 2.7F}, {0.75F, 0.7F, 0.8F}, {4.5F, 4.1F, 4.2F}};
  for (const auto& [cubes, windings] :
       {Case{{{0, 2, false}, {1, 2, false}}, {1, 2, 1, 1, 0}},
        Case{{{-1, 5, false}, {0, 2, false}}, {2, 2, 1, 2, 0}},
        Case{{{-1, 5, false}, {0, 2, true}}, {0, 0, 1, 0, 0}},
        Case{{{0, 2, false}, {0, 2, false}}, {2, 2, 0, 2, 0}}, Case{{{0, 2, true}}, {-1, -1, 0, -1, 0}},
        Case{{{-1, 5, false}, {0, 2, false}, {0.5F, 0.5F, false}}, {2, 2, 1, 3, 0}}}) {
    Shape shape;
    for (const auto& [low, side, turned] : cubes) add_cube(shape, low, side, turned);
    for (const char* world : worlds) {
      SceneOptions options{.world = world};
      if (std::string(world) != "float") options.contains = points;
      const Scene scene = shape.scene(options);
      EXPECT_EQ(scene.info().oriented, 1);
      const auto inside = scene.inside(points);
      // Along an axis, through edges and corners, and anywhere.
      for (const std::array<float, 3>& way :
           {std::array<float, 3>{1, 0, 0}, {0, 0, -1}, {1, 1, 1}, {-0.3F, 0.7F, 0.1F}}) {
        std::vector<Ray> rays;
        for (const Point& p : points) rays.push_back({{p[0], p[1], p[2]}, {way[0], way[1], way[2]}, endless});
        EXPECT_THAT(scene.count(rays).sides, testing::ElementsAreArray(windings));
      }
      for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(inside[i], windings[i] & 1) << i;
    }
  }
}

/// Three threads ask without a pause until the move has come; each answer is of one place or the other.
TEST(Move, DoesNotWaitForThoseWhoAsk) {
  const Shape shape = cube();
  std::vector<Point> other = shape.corners;
  for (Point& corner : other) corner[0] += 1;
  Scene scene = shape.scene();
  const std::vector<Ray> rays(3'000, Ray{{-1, 0.25F, 0.5F}, {2, 0, 0}, endless});
  std::atomic<int> asking = 0;
  std::atomic<bool> seen_all = true;
  std::atomic<int> arrived = 0;
  std::vector<std::thread> askers;
  for (int i = 0; i < 3; ++i)
    askers.emplace_back([&] {
      const auto limit = std::chrono::steady_clock::now() + std::chrono::minutes(2);
      while (std::chrono::steady_clock::now() < limit) {
        const std::vector<double> t = scene.nearest(rays, false, 1).t;
        ++asking;
        if (std::any_of(t.begin(), t.end(),
                        [&](double each) { return each != t[0] || (each != 0.5 && each != 1); }))
          seen_all = false;
        if (t[0] == 1) {
          ++arrived;
          return;
        }
      }
    });
  while (asking < 6) std::this_thread::yield();
  scene.move(other, 1);
  for (std::thread& asker : askers) asker.join();
  EXPECT_EQ(arrived, 3);
  EXPECT_TRUE(seen_all);
}

}  // namespace
}  // namespace hitpipe::questions_test
