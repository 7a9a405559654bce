// The corners of a caller's mesh, and the cube that is fitted around it.
#include "library/mesh.hpp"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/library/scenes.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::mesh_test {
namespace {

using namespace scenes;  // NOLINT(google-build-using-namespace): what this file is about
using testing::ElementsAre;

/// What a corner that no triangle uses is counts neither in the cube nor in an answer.
TEST(Mesh, CornerThatNoTriangleUsesMayBeAnything) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const Transform half{{0, 0, 0}, 0.5};
  const Shape plain = soup(50, 17);
  for (const char* world : worlds) {
    const bool floats = std::string(world) == "float";
    for (const Point& corner :
         {Point{nan, 0, 0}, Point{0, endless, 0}, Point{0, 0, -0x1p30F}, Point{0.1F, 3, 0}}) {
      Shape more = plain;
      more.corners.push_back(corner);
      for (const Transform* transform : {static_cast<const Transform*>(nullptr), floats ? nullptr : &half}) {
        const SceneOptions options{.world = world, .transform = transform};
        if (transform == nullptr && !floats) {
          EXPECT_EQ(more.scene(options).info().transform.scale, plain.scene(options).info().transform.scale);
          continue;
        }
        Scene scene = more.scene(options);
        EXPECT_TRUE(all_answers(scene, 1) == all_answers(plain.scene(options), 1));
        scene.move(more.corners);
        EXPECT_TRUE(all_answers(scene, 1) == all_answers(plain.scene(options), 1));
      }
    }
  }
}

TEST(Mesh, CubeContainsMoreWhereThatIsAsked) {
  const Ray ray{{-9, 0.25F, 0.5F}, {2, 0, 0}, endless};
  const std::vector<Ray> rays{ray};
  EXPECT_THAT(message_of<Error>([&] { static_cast<void>(cube().scene({.world = "20+1s20"}).any(rays)); }),
              testing::StartsWith("ray 0: its origin is (-"));
  const std::vector<Point> contains{{-9, 0.25F, 0.5F}, {0.5F, 0.5F, 2}};
  const Scene scene = cube().scene({.world = "20+1s20", .contains = contains});
  EXPECT_NEAR(scene.nearest(rays).t[0], 4.5, 1e-4);
  // That is the transform of the bounds of all.
  const Transform all = fit({.min = {-9, 0, 0}, .max = {1, 1, 2}});
  EXPECT_EQ(scene.info().transform.scale, all.scale);
  EXPECT_THAT(scene.info().transform.offset, testing::ElementsAreArray(all.offset));
}

TEST(Mesh, WhatTheCubeCannotContainIsRefused) {
  const auto refusal = [](const Shape& shape, const SceneOptions& options) {
    return message_of<std::exception>([&] { static_cast<void>(shape.scene(options)); });
  };
  const Transform one{{0, 0, 0}, 1};
  const std::vector<Point> bad{{0, 0, 0}, {0, std::numeric_limits<float>::quiet_NaN(), 0}};
  EXPECT_EQ(refusal(cube(), {.world = "20+1s20", .contains = bad}),
            "point 1: y = nan; allowed is -2^24 to 2^24");
  EXPECT_EQ(refusal(cube(), {.world = "20+1s20", .transform = &one, .contains = bad}),
            "contains: a transform is given; it alone says what the cube holds");
  EXPECT_EQ(refusal(cube(), {.contains = bad}),
            "contains: the float world has no cube; it takes rays from everywhere");
  Transform out{};
  const hitpipe_mesh nothing{};
  EXPECT_EQ(hitpipe_fit_scene(nullptr, nullptr, 0, &out), HITPIPE_BAD_ARGUMENT);
  EXPECT_EQ(hitpipe_fit_scene(&nothing, nullptr, 1, &out), HITPIPE_BAD_ARGUMENT);
  EXPECT_STREQ(hitpipe_error(), "points: a null pointer is not allowed");
  EXPECT_EQ(hitpipe_fit_scene(&nothing, nullptr, 0, nullptr), HITPIPE_BAD_ARGUMENT);
  EXPECT_EQ(hitpipe_fit_scene(&nothing, nullptr, 0, &out), HITPIPE_OK);
  EXPECT_EQ(out.scale, 1);
  EXPECT_EQ(hitpipe_fit_scene(&nothing, bad.front().data(), 1, &out), HITPIPE_BAD_MESH);
  const std::vector<Point> two{{0, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(hitpipe_fit_scene(&nothing, two.front().data(), 2, &out), HITPIPE_OK);
  EXPECT_EQ(out.offset[0], 1.5);
}

}  // namespace
}  // namespace hitpipe::mesh_test
