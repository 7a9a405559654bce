// Placing a scene in the cube, and one message for each way in which it cannot be placed.
#include "rays/scene/scene.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"

namespace hitpipe::ref::scene_test {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// A tetrahedron of side about 2, eye and two lights, all in units of `unit`.
SceneDescription tetrahedron(double unit = 1.0) {
  SceneDescription scene;
  scene.name = "tetrahedron";
  for (const glm::dvec3& p : {glm::dvec3(0.1, 0.2, 0.3), {2.3, 0.1, 0.2}, {0.7, 1.9, 0.4}, {0.9, 0.6, 2.1}})
    scene.mesh.vertices.emplace_back(p * unit);
  scene.mesh.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
  scene.materials = {{}};
  scene.eye = glm::dvec3(1.1, 1.3, 7.7) * unit;
  scene.target = glm::dvec3(1.0, 0.9, 0.5) * unit;
  scene.lights = {{glm::dvec3(-3.1, 4.2, 5.3) * unit, {1.0, 0.9, 0.8}},
                  {glm::dvec3(4.4, 2.0, 3.0) * unit, {0.2, 0.2, 0.3}}};
  return scene;
}

std::string placing_error(SceneDescription scene) {
  return message_of<std::exception>([&] { return place(std::move(scene)); });
}

TEST(Placing, EveryCoordinateLiesWithinTheBoundAndTheExtremesOnIt) {
  const Scene scene = place(tetrahedron());
  constexpr auto bound = static_cast<float>(cube_bound);
  EXPECT_EQ(cube_bound, static_cast<double>(bound));
  std::vector<glm::vec3> points = scene.mesh.vertices;
  points.push_back(scene.camera.eye);
  for (const Light& light : scene.lights) points.push_back(light.position);
  float largest = 0;
  for (const glm::vec3& p : points)
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(p[k]));
  EXPECT_EQ(largest, bound);
}

TEST(Placing, TheStoredTransformTakesOwnUnitsToTheCube) {
  const SceneDescription before = tetrahedron();
  const Scene scene = place(before);
  EXPECT_EQ(scene.camera.eye, glm::vec3(scene.to_cube.to_cube(before.eye)));
  EXPECT_EQ(scene.mesh.vertices[3], glm::vec3(scene.to_cube.to_cube(glm::dvec3(before.mesh.vertices[3]))));
  EXPECT_LT(glm::distance(scene.to_cube.to_own(scene.to_cube.to_cube(before.eye)), before.eye), 1e-14);
}

TEST(Placing, PowerOfTwoUnitsChangeNoBit) {
  const Scene scene = place(tetrahedron());
  for (const int power : {-100, -31, -1, 1, 24, 90}) {
    const Scene scaled = place(tetrahedron(std::ldexp(1.0, power)));
    EXPECT_EQ(scaled.mesh.vertices, scene.mesh.vertices) << power;
    EXPECT_EQ(scaled.camera.eye, scene.camera.eye) << power;
    EXPECT_EQ(scaled.camera.forward, scene.camera.forward) << power;
    EXPECT_EQ(scaled.camera.right, scene.camera.right) << power;
    EXPECT_EQ(scaled.lights[0].position, scene.lights[0].position) << power;
    EXPECT_EQ(scaled.lights[1].position, scene.lights[1].position) << power;
  }
}

TEST(Placing, TinyAndHugeUnitsWork) {
  const Scene scene = place(tetrahedron());
  for (const double unit : {1e-30, 1e-12, 1e12, 1e30}) {
    const Scene scaled = place(tetrahedron(unit));
    ASSERT_EQ(scaled.mesh.triangles.size(), 4U) << unit;
    for (std::size_t v = 0; v < 4; ++v)
      EXPECT_LT(glm::distance(scaled.mesh.vertices[v], scene.mesh.vertices[v]), 1e-6F) << unit;
    EXPECT_LT(glm::distance(scaled.camera.forward, scene.camera.forward), 1e-6) << unit;
  }
}

TEST(Placing, TrianglesThatLoseTheirAreaAreDroppedWithTheirMaterial) {
  SceneDescription scene = tetrahedron();
  scene.mesh.vertices[1] = {2.3F, std::nextafter(0.2F, 1.0F), 0.3F};  // a sliver with 0 and the new vertex
  scene.mesh.vertices.push_back({1.1F, 0.2F, 0.3F});
  scene.mesh.triangles = {{0, 2, 3}, {0, 1, 4}, {1, 2, 3}};
  scene.mesh.materials = {5, 6, 7};
  for (LightSource& light : scene.lights) light.position *= 100.0;
  const Scene placed = place(scene);
  EXPECT_EQ(placed.mesh.triangles, (std::vector<glm::uvec3>{{0, 2, 3}, {1, 2, 3}}));
  EXPECT_EQ(placed.mesh.materials, (std::vector<std::uint8_t>{5, 7}));
  EXPECT_EQ(placed.mesh.dropped.size(), 1U);

  scene.mesh.triangles = {{0, 1, 4}};
  scene.mesh.materials = {6};
  EXPECT_EQ(placing_error(scene),
            "scene: no triangle keeps an area when its corners are rounded to binary32 in the cube; at least "
            "one must");
}

TEST(Placing, UnusedVerticesDoNotCount) {
  SceneDescription scene = tetrahedron();
  scene.mesh.vertices.push_back({1e9F, 0.0F, 0.0F});
  const Scene with = place(scene);
  EXPECT_EQ(with.to_cube.scale, place(tetrahedron()).to_cube.scale);
  EXPECT_LE(with.mesh.vertices[4].x, 1.0F);
}

TEST(Placing, CameraAxesAreUnitVectorsAtRightAngles) {
  const Camera camera = place(tetrahedron()).camera;
  for (const glm::dvec3& axis : {camera.forward, camera.right, camera.up})
    EXPECT_NEAR(glm::length(axis), 1.0, 1e-15);
  EXPECT_NEAR(glm::dot(camera.forward, camera.right), 0.0, 1e-15);
  EXPECT_NEAR(glm::dot(camera.forward, camera.up), 0.0, 1e-15);
  EXPECT_GT(camera.up.y, 0.9);
}

TEST(Placing, LengthOfUpDoesNotMatter) {
  const Camera camera = place(tetrahedron()).camera;
  for (const double length : {1e-300, 1e-3, 1e300}) {
    SceneDescription scene = tetrahedron();
    scene.up *= length;
    EXPECT_EQ(place(scene).camera.up, camera.up) << length;
  }
}

TEST(Placing, CamerasThatCannotBePlacedAreRejected) {
  SceneDescription scene = tetrahedron();
  scene.eye.y = not_a_number;
  EXPECT_EQ(placing_error(scene), "camera: eye (1.1, nan, 7.7) must be finite");
  scene = tetrahedron();
  scene.target.x = -infinite;
  EXPECT_EQ(placing_error(scene), "camera: target (-inf, 0.9, 0.5) must be finite");
  scene = tetrahedron();
  scene.up = {0.0, 0.0, 0.0};
  EXPECT_EQ(placing_error(scene), "camera: up (0, 0, 0) must be finite and not zero");
  scene = tetrahedron();
  scene.eye = scene.target = {1.0, 2.0, 3.0};
  EXPECT_EQ(placing_error(scene), "camera: eye and target are both (1, 2, 3); they must differ");
  scene = tetrahedron();
  scene.eye = {1.0, 2.0, 3.0};
  scene.target = {1.0, 2.0, 0.0};
  scene.up = {0.0, 0.0, 5e-3};
  EXPECT_EQ(
      placing_error(scene),
      "camera: up (0, 0, 0.005) is parallel to the view from (1, 2, 3) to (1, 2, 0); choose another up");
  for (const auto& [fov, text] : {std::pair(0.0, "0"), {180.0, "180"}, {-5.0, "-5"}, {not_a_number, "nan"}}) {
    scene = tetrahedron();
    scene.fov_degrees = fov;
    EXPECT_EQ(placing_error(scene), std::string("camera: field of view of ") + text +
                                        " degrees; allowed is more than 0 and less than 180");
  }
}

TEST(Placing, LightsThatCannotBePlacedAreRejected) {
  SceneDescription scene = tetrahedron();
  scene.lights[1].position.z = infinite;
  EXPECT_EQ(placing_error(scene), "light 1: position (4.4, 2, inf) must be finite");
  scene = tetrahedron();
  scene.lights[0].intensity.y = -1.0;
  EXPECT_EQ(placing_error(scene), "light 0: intensity (1, -1, 0.8) must be finite and not negative");
  scene.lights[0].intensity.y = not_a_number;
  EXPECT_EQ(placing_error(scene), "light 0: intensity (1, nan, 0.8) must be finite and not negative");
}

TEST(Placing, OrthographicImageIsAsHighAsTheFieldOfViewAtTheTarget) {
  SceneDescription scene = tetrahedron();
  const Camera before = place(scene).camera;
  EXPECT_EQ(before.projection, Projection::perspective);
  scene.projection = Projection::orthographic;
  const Scene placed = place(scene);
  EXPECT_EQ(placed.camera.projection, Projection::orthographic);
  const double own = glm::length(scene.target - scene.eye) * std::tan(20.0 * 3.14159265358979 / 180.0);
  EXPECT_NEAR(placed.camera.half_height, own * placed.to_cube.scale, 1e-12);
  EXPECT_EQ(placed.camera.eye, before.eye);
  EXPECT_EQ(placed.camera.forward, before.forward);
  for (const int power : {-100, 24}) {
    SceneDescription scaled = tetrahedron(std::ldexp(1.0, power));
    scaled.projection = Projection::orthographic;
    EXPECT_EQ(place(scaled).camera.half_height, placed.camera.half_height) << power;
  }
}

TEST(Placing, OrthographicImagesThatCannotBeMadeAreRejected) {
  SceneDescription scene = tetrahedron();
  scene.projection = Projection::orthographic;
  scene.target.z = 1e9;
  EXPECT_EQ(
      placing_error(scene),
      "camera: orthographic image of height 7.2794e+08; allowed is more than 0 and at most 7.87201e+06");
  scene.target.z = 1e300;
  EXPECT_EQ(
      placing_error(scene),
      "camera: orthographic image of height 7.2794e+299; allowed is more than 0 and at most 7.87201e+06");
  scene.fov_degrees = 5e-324;
  scene.target.z = 0.5;
  EXPECT_EQ(placing_error(scene),
            "camera: orthographic image of height 0; allowed is more than 0 and at most 7.87201e+06");
  scene.projection = Projection::perspective;
  scene.fov_degrees = 40.0;
  scene.target.z = 1e9;
  EXPECT_EQ(placing_error(scene), "no exception");
}

TEST(Placing, SunsHaveDirectionsAndNoPlace) {
  SceneDescription scene = tetrahedron();
  scene.lights.clear();
  const double scale = place(scene).to_cube.scale;
  for (const double length : {1e-300, 1.0, 1e300}) {
    scene.lights = {{glm::dvec3(3.0, 4.0, 0.0) * length, {1.0, 0.5, 0.25}, LightKind::sun}};
    const Scene placed = place(scene);
    EXPECT_EQ(placed.to_cube.scale, scale) << length;
    ASSERT_EQ(placed.lights.size(), 1U);
    EXPECT_EQ(placed.lights[0].kind, LightKind::sun);
    EXPECT_EQ(placed.lights[0].position, glm::vec3(0.6F, 0.8F, 0.0F)) << length;
    EXPECT_EQ(placed.lights[0].intensity, glm::vec3(1.0F, 0.5F, 0.25F));
  }
  scene.lights[0].kind = LightKind::point;
  scene.lights[0].position = {30.0, 40.0, 0.0};
  EXPECT_LT(place(scene).to_cube.scale, 0.5 * scale);
  // The eye, not the sun, is to blame.
  scene.lights = {{{1e9, 0.0, 0.0}, {1.0, 1.0, 1.0}, LightKind::sun}};
  scene.eye = {0.0, 0.0, 1e5};
  EXPECT_EQ(placing_error(scene).find("camera: eye (0, 0, 100000) is so far from the mesh"), 0U);
}

TEST(Placing, SunsWithoutADirectionAreRejected) {
  SceneDescription scene = tetrahedron();
  scene.lights[1].kind = LightKind::sun;
  scene.lights[1].position = {0.0, -0.0, 0.0};
  EXPECT_EQ(placing_error(scene), "light 1: direction (0, -0, 0) must be finite and not zero");
  scene.lights[1].position = {0.0, infinite, 0.0};
  EXPECT_EQ(placing_error(scene), "light 1: direction (0, inf, 0) must be finite and not zero");
  scene.lights[1].position = {0.0, 1.0, 0.0};
  scene.lights[1].intensity.x = -1.0;
  EXPECT_EQ(placing_error(scene), "light 1: intensity (-1, 0.2, 0.3) must be finite and not negative");
}

TEST(Placing, MaterialsOutOfRangeAreRejected) {
  SceneDescription scene = tetrahedron();
  scene.materials = {{},
                     {.albedo = {0.5F, 0.5F, 0.5F}, .reflect = {0.5F, 0.25F, 0.5F}, .transmit = {0, 0, 0}}};
  EXPECT_EQ(placing_error(scene), "no exception");
  scene.materials[1].transmit.y = 0.5F;
  EXPECT_EQ(placing_error(scene),
            "material 1: albedo, reflect and transmit add up to (1, 1.25, 1); at most 1 is allowed");
  scene.materials[1].reflect.z = -0.25F;
  EXPECT_EQ(placing_error(scene), "material 1: reflect (0.5, 0.25, -0.25) must lie within 0 and 1");
  scene.materials[1] = {.albedo = {0.0F, static_cast<float>(not_a_number), 0.0F}};
  EXPECT_EQ(placing_error(scene), "material 1: albedo (0, nan, 0) must lie within 0 and 1");
  for (const auto& [index, text] :
       {std::pair(0.0, "0"), {-1.5, "-1.5"}, {infinite, "inf"}, {not_a_number, "nan"}}) {
    scene.materials[1] = {.refractive_index = static_cast<float>(index)};
    EXPECT_EQ(placing_error(scene),
              std::string("material 1: refractive index ") + text + " must be finite and more than 0");
  }
}

TEST(Placing, PointsThatMakeTheMeshVanishAreRejected) {
  SceneDescription scene = tetrahedron();
  scene.eye = {0.0, 0.0, 1e5};
  EXPECT_EQ(
      placing_error(scene),
      "camera: eye (0, 0, 100000) is so far from the mesh that 2.2e-05 of the scene would be left for it; at "
      "least 0.0009765625 is needed");
  scene = tetrahedron();
  scene.lights[1].position = {1e300, 0.0, 0.0};
  EXPECT_EQ(placing_error(scene),
            "light 1: position (1e+300, 0, 0) is so far from the mesh that 2.2e-300 of the scene would be "
            "left for it; "
            "at least 0.0009765625 is needed");
  scene.lights[1].position = {2000.0, 0.0, 0.0};
  EXPECT_EQ(placing_error(scene), "no exception");
}

TEST(LoadScene, MeshFileGetsACameraThatSeesItAndTwoLights) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("hitpipe_scene_{}.obj", ::getpid());
  std::ofstream(file) << "v 1e6 0 0\nv 1000003 0 0\nv 1e6 4 0\nf 1 2 3\n";
  const Scene scene = load_scene(file.string());
  EXPECT_EQ(scene.name, file.stem().string());
  EXPECT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.materials.size(), 1U);
  const glm::dvec3 centre = scene.to_cube.to_cube({1000001.5, 2.0, 0.0});
  EXPECT_NEAR(glm::dot(glm::normalize(centre - glm::dvec3(scene.camera.eye)), scene.camera.forward), 1.0,
              1e-6);

  SceneOptions options;
  options.eye = {1e6, 1.0, 9.0};
  options.target = {1e6, 1.0, 0.0};
  options.up = {1.0, 0.0, 0.0};
  options.fov_degrees = 90.0;
  options.projection = Projection::orthographic;
  options.lights = {{{1e6, 5.0, 5.0}, {0.5, 0.5, 0.5}}};
  const Scene chosen = load_scene(file.string(), options);
  EXPECT_EQ(chosen.camera.eye, glm::vec3(chosen.to_cube.to_cube({1e6, 1.0, 9.0})));
  EXPECT_EQ(chosen.camera.forward, glm::dvec3(0.0, 0.0, -1.0));
  EXPECT_EQ(chosen.camera.up, glm::dvec3(1.0, 0.0, 0.0));
  EXPECT_NEAR(chosen.camera.tan_half_height, 1.0, 1e-15);
  EXPECT_EQ(scene.camera.projection, Projection::perspective);
  EXPECT_EQ(chosen.camera.projection, Projection::orthographic);
  ASSERT_EQ(chosen.lights.size(), 1U);
  EXPECT_EQ(chosen.lights[0].intensity, glm::vec3(0.5F));
  std::filesystem::remove(file);
}

TEST(LoadScene, RoomIsSeenFromInside) {
  // A tetrahedron in a box of twelve triangles; without the ceiling it is not a room.
  const std::string room =
      "v 0 0 0\nv 4 0 0\nv 4 3 0\nv 0 3 0\nv 0 0 5\nv 4 0 5\nv 4 3 5\nv 0 3 5\n"
      "v 1 1 1\nv 2 1 1\nv 1 2 1\nv 1 1 2\nf 9 10 11\nf 9 10 12\nf 9 11 12\nf 10 11 12\n"
      "f 1 2 3\nf 1 3 4\nf 5 6 7\nf 5 7 8\nf 1 2 6\nf 1 6 5\nf 1 4 8\nf 1 8 5\nf 2 3 7\nf 2 7 6\n";
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / fmt::format("hitpipe_room_{}.obj", ::getpid());
  const auto inside = [&](const glm::vec3& point, const Scene& scene) {
    const glm::dvec3 own = scene.to_cube.to_own(point);
    return own.x > 0 && own.x < 4 && own.y > 0 && own.y < 3 && own.z > 0 && own.z < 5;
  };
  std::ofstream(file) << room << "f 4 3 7\nf 4 7 8\n";
  const Scene closed = load_scene(file.string());
  EXPECT_TRUE(inside(closed.camera.eye, closed));
  for (const Light& light : closed.lights) EXPECT_TRUE(inside(light.position, closed));
  const glm::dvec3 content = closed.to_cube.to_cube({1.5, 1.5, 1.5});
  EXPECT_NEAR(glm::dot(glm::normalize(content - glm::dvec3(closed.camera.eye)), closed.camera.forward), 1.0,
              1e-6);

  std::ofstream(file) << room << "f 4 3 7\n";
  const Scene open = load_scene(file.string());
  EXPECT_FALSE(inside(open.camera.eye, open));
  std::filesystem::remove(file);
}

TEST(LoadScene, UnknownNameIsRejectedWithTheBuiltInOnes) {
  EXPECT_EQ(
      message_of<std::exception>([] { return load_scene("teapot"); }),
      "scene \"teapot\": no built-in scene and no file of that name; built-in are: " + built_in_names());
  SceneOptions options;
  options.triangles = 1000;
  EXPECT_EQ(
      message_of<std::exception>([&] { return load_scene("none/teapot.obj", options); }),
      "scene \"none/teapot.obj\": a mesh file has the triangles it has; their number can be chosen for: " +
          scaling_names());
  EXPECT_EQ(message_of<std::exception>([] { return load_scene("none/teapot.obj"); }),
            "mesh file \"none/teapot.obj\": no such file; give a .obj, .ply, .stl, .gltf or .glb file");
}

}  // namespace
}  // namespace hitpipe::ref::scene_test
