// A scene that is made again from a core's image: the same triangles under the same numbers, in the same cube.
#include "sw_ref/core/image_scene.hpp"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "sw_ref/scene/mesh_scene.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/small_scene.hpp"

namespace hitpipe::ref::image_scene_test {
namespace {

/// Four triangles, of which the middle two are too thin for 8 bits.
SceneDescription needles() {
  SourceMesh mesh;
  mesh.vertices = {{7, 0, 0}, {8, 0, 0}, {7, 1, 0}, {8, 0.0001, 0}, {7, 0, 1}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 3, 1}, {0, 1, 4}};
  return mesh_scene(std::move(mesh), "needles");
}

bool in_cube(const glm::vec3& point) {
  return std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)}) <=
         static_cast<float>(cube_bound);
}

TEST(ImageScene, HasTheTrianglesOfTheScene) {
  for (const hls::WorldBits& bits : {hls::WorldBits{}, hls::WorldBits{8, 0, 8}, hls::WorldBits{24, 1, 24}}) {
    const IntScene scene = int_scene(sim::hills(), bits, {.build = surface_area_build});
    const IntScene again = image_scene(core_image(scene), bits, "again");
    EXPECT_EQ(again.bits, bits);
    EXPECT_EQ(again.scene.name, "again");
    EXPECT_EQ(again.bvh, std::nullopt);
    ASSERT_EQ(again.mesh.triangles.size(), scene.mesh.triangles.size());
    EXPECT_EQ(again.mesh.mesh.dropped, scene.mesh.mesh.dropped);
    for (std::uint32_t i = 0; i < again.mesh.triangles.size(); ++i) {
      ASSERT_EQ(again.mesh.triangles[i].corners, scene.mesh.triangles[i].corners) << i;
      ASSERT_EQ(again.mesh.mesh.corners(i).c, scene.mesh.mesh.corners(i).c) << i;
      ASSERT_EQ(again.scene.mesh.corners(i).b, scene.scene.mesh.corners(i).b) << i;
    }
  }
}

TEST(ImageScene, KeepsNumbersAndCube) {
  const hls::WorldBits bits{8, 0, 8};
  const Scene loaded = place(needles());
  const IntScene again = image_scene(core_image(int_scene(loaded, bits)), bits, "needles");
  EXPECT_EQ(again.mesh.mesh.dropped, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(again.mesh.triangles.size(), 2U);
  EXPECT_EQ(again.scene.to_cube.offset, loaded.to_cube.offset);
  EXPECT_EQ(again.scene.to_cube.scale, loaded.to_cube.scale);
  EXPECT_TRUE(again.scene.to_cube.chosen);
  EXPECT_NEAR(again.scene.mesh_part, loaded.mesh_part, 0.01);
}

TEST(ImageScene, IsSeenAsAMeshFile) {
  const Scene loaded = place(needles());
  const Scene again = image_scene(core_image(int_scene(loaded, {})), {}, "needles").scene;
  EXPECT_LT(glm::distance(again.camera.eye, loaded.camera.eye), 1e-4F);
  EXPECT_TRUE(in_cube(again.camera.eye)) << "its corners are rounded, and its eye was the cube's farthest";
  EXPECT_EQ(again.camera.tan_half_height, loaded.camera.tan_half_height);
  ASSERT_EQ(again.lights.size(), 2U);
  EXPECT_LT(glm::distance(again.lights[1].position, loaded.lights[1].position), 1e-4F);
}

TEST(ImageScene, IsSeenFromItsCube) {
  SceneDescription description = needles();
  description.cube = CubeChoice{{7.5, 0.5, 0.5}, 0.75};
  description.eye = {7.5, 0.5, 1.0};
  const CoreImage image = core_image(int_scene(place(description), {}));
  const Scene again = image_scene(image, {}, "needles").scene;
  EXPECT_TRUE(in_cube(again.camera.eye));
  EXPECT_GT(again.camera.eye.z, 0.99F);
  const glm::dvec3 there = glm::normalize(needles().target - needles().eye);
  EXPECT_GT(glm::dot(again.camera.forward, there), 0.999999);
}

TEST(ImageScene, IsSeenAsTheUserSays) {
  SceneDescription description = needles();
  SceneOptions options;
  options.eye = {7.25, 0.5, 1.5};
  options.target = {7.5, 0.25, 0.0};
  options.up = {1.0, 0.0, 0.0};
  options.fov_degrees = 50;
  options.lights = {{{7.5, 1.0, 1.25}, {0.5, 0.25, 1.0}}};
  const Scene loaded = place(with_options(description, options));
  const CoreImage image = core_image(int_scene(loaded, {}));
  const Scene again = image_scene(image, {}, "needles", options).scene;
  EXPECT_EQ(again.camera.eye, loaded.camera.eye);
  EXPECT_EQ(again.camera.forward, loaded.camera.forward);
  EXPECT_EQ(again.camera.up, loaded.camera.up);
  EXPECT_EQ(again.camera.tan_half_height, loaded.camera.tan_half_height);
  ASSERT_EQ(again.lights.size(), 1U);
  EXPECT_EQ(again.lights[0].position, loaded.lights[0].position);
  EXPECT_EQ(again.lights[0].intensity, loaded.lights[0].intensity);

  options.eye = {7.25, 0.5, 9};
  const std::string message =
      message_of<std::runtime_error>([&] { (void)image_scene(image, {}, "needles", options); });
  EXPECT_EQ(message.substr(message.find(": ray")),
            ": ray 0 of the picture begins at the eye (7.25, 0.5, 9); rays must begin in the cube");
}

TEST(ImageScene, OfNothingOrOfAnotherGridIsRefused) {
  Scene empty = sim::hills();
  empty.mesh = {};
  const CoreImage image = core_image(int_scene(empty, {}));
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)image_scene(image, {}, "empty"); }),
            "the image has no triangle; at least one is needed");
  EXPECT_EQ(message_of<std::invalid_argument>([&] {
              (void)image_scene(image, {16, 1, 16}, "empty");
            }),
            "the image has a grid of other bits");
  CoreImage few = core_image(int_scene(sim::hills(), {}));
  few.header.missing = (1U << 26) + 1;
  EXPECT_EQ(message_of<std::runtime_error>([&] { (void)image_scene(few, {}, "few"); }),
            "the image lacks 67108865 triangles of its mesh; allowed are 67108864 at most");
}

}  // namespace
}  // namespace hitpipe::ref::image_scene_test
