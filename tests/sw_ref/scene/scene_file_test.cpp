// Scene files: their contents, and one message for each kind of error.
#include "sw_ref/scene/scene_file.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "sw_ref/scene/built_in.hpp"
#include "sw_ref/scene/load_scene.hpp"
#include "tests/message_of.hpp"
#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::ref::scene_file_test {
namespace {

/// Three groups in one OBJ; the second has a triangle without area, which is dropped.
constexpr const char* three_groups =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "g lower\nusemtl stone\nf 1 2 3\nf 1 2 4\n"
    "g middle\nusemtl glass\nf 1 1 2\nf 1 3 4\n"
    "g upper\nusemtl stone\nf 2 3 4\n";

class SceneFile : public testing::Test {
 protected:
  void SetUp() override { folder_.write("mesh.obj", three_groups); }
  [[nodiscard]] std::string write(const std::string& text) const {
    return folder_.write("my.json", text).string();
  }
  [[nodiscard]] SceneDescription read(const std::string& text) const { return read_scene_file(write(text)); }
  void rejected(const std::string& text, const std::string& message) const {
    const std::string file = write(text);
    EXPECT_EQ(message_of<std::exception>([&] { return read_scene_file(file); }),
              "scene file \"" + file + "\": " + message);
  }

  const sim::TemporaryFolder folder_;
};

TEST_F(SceneFile, ReadsAllThatItMaySay) {
  const SceneDescription scene = read(R"({
    "mesh": "mesh.obj",
    "camera": {"eye": [1, 2, 9], "target": [0.5, 0, 0], "up": [0, 0, 1], "fov": 33.5},
    "lights": [{"position": [1, 2, 3]}, {"position": [4, 5, 6], "intensity": [0.5, 0, 2]},
               {"position": [4, 5, 7], "intensity": 0.25}],
    "materials": {"dull": {"albedo": 0.25}, "glass": {"transmit": [0.9, 1, 0.8], "refractive_index": 1.5},
                  "mirror": {"albedo": [0.1, 0.2, 0.1], "reflect": 0.75}},
    "default_material": "dull",
    "assign": [{"material": "glass", "group": "middle"}, {"material": "mirror", "triangles": [4, 4]}]
  })");
  EXPECT_EQ(scene.name, "my");
  EXPECT_EQ(scene.eye, glm::dvec3(1, 2, 9));
  EXPECT_EQ(scene.target, glm::dvec3(0.5, 0, 0));
  EXPECT_EQ(scene.up, glm::dvec3(0, 0, 1));
  EXPECT_EQ(scene.fov_degrees, 33.5);
  ASSERT_EQ(scene.lights.size(), 3U);
  EXPECT_EQ(scene.lights[0].intensity, glm::dvec3(1));
  EXPECT_EQ(scene.lights[1].position, glm::dvec3(4, 5, 6));
  EXPECT_EQ(scene.lights[1].intensity, glm::dvec3(0.5, 0, 2));
  EXPECT_EQ(scene.lights[2].intensity, glm::dvec3(0.25));
  ASSERT_EQ(scene.mesh.triangles.size(), 4U);
  const auto material = [&](std::size_t triangle) {
    return scene.materials.at(scene.mesh.materials.at(triangle));
  };
  EXPECT_EQ(material(0).albedo, glm::vec3(0.25F));
  EXPECT_EQ(material(1).albedo, glm::vec3(0.25F));
  EXPECT_EQ(material(2).transmit, glm::vec3(0.9F, 1.0F, 0.8F));
  EXPECT_EQ(material(2).albedo, glm::vec3(0.0F));
  EXPECT_EQ(material(2).refractive_index, 1.5F);
  EXPECT_EQ(material(3).reflect, glm::vec3(0.75F));
  EXPECT_EQ(load_scene(write(R"({"mesh": "mesh.obj"})")).mesh.triangles.size(), 4U);
}

TEST_F(SceneFile, ReadsProjectionsAndSuns) {
  const SceneDescription scene = read(R"({
    "mesh": "mesh.obj", "camera": {"projection": "orthographic"},
    "lights": [{"direction": [0, 2, 0], "intensity": 0.5}, {"position": [0, 2, 0]}]})");
  EXPECT_EQ(scene.projection, Projection::orthographic);
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].kind, LightKind::sun);
  EXPECT_EQ(scene.lights[0].position, glm::dvec3(0, 2, 0));
  EXPECT_EQ(scene.lights[0].intensity, glm::dvec3(0.5));
  EXPECT_EQ(scene.lights[1].kind, LightKind::point);
  const char* const city = R"({"built_in": "city", "triangles": 100000, "camera": {)";
  EXPECT_EQ(read(city + std::string("}}")).projection, Projection::orthographic);
  EXPECT_EQ(read(city + std::string(R"("projection": "perspective"}})")).projection, Projection::perspective);
}

TEST_F(SceneFile, WhatItLeavesOutIsTheScenesOwn) {
  const SceneDescription own = make_built_in("spheres", {});
  const SceneDescription scene = read(R"({"built_in": "spheres", "camera": {"fov": 20}})");
  EXPECT_EQ(scene.fov_degrees, 20.0);
  EXPECT_EQ(scene.eye, own.eye);
  EXPECT_EQ(scene.lights.size(), own.lights.size());
  EXPECT_EQ(scene.mesh.materials, own.mesh.materials);
  EXPECT_EQ(scene.stand_in_for, "Spheres");
}

TEST_F(SceneFile, AssignsByMaterialOfTheMesh) {
  const SceneDescription scene = read(R"({"mesh": "mesh.obj", "materials": {"m": {"reflect": 1}},
                                          "assign": [{"material": "m", "group_material": "stone"}]})");
  EXPECT_EQ(scene.mesh.materials, (std::vector<std::uint8_t>{1, 1, 0, 1}));
}

TEST_F(SceneFile, TrianglesAskedForOutsideWin) {
  const std::string file = write(R"({"built_in": "statue", "triangles": 20000})");
  EXPECT_NEAR(static_cast<double>(read_scene_file(file).mesh.triangles.size()), 20'000.0, 400.0);
  SceneOptions options;
  options.triangles = 10'000;
  options.fov_degrees = 12.0;
  const SceneDescription scene = describe_scene(file, options);
  EXPECT_NEAR(static_cast<double>(scene.mesh.triangles.size()), 10'000.0, 200.0);
  EXPECT_EQ(scene.fov_degrees, 12.0);
}

struct Wrong {
  const char* text;
  std::string message;
};

TEST_F(SceneFile, WithAnythingWrongRejected) {
  const std::string keys = "mesh, built_in, triangles, camera, lights, materials, default_material, assign";
  const std::vector<Wrong> all{
      {R"([])", "must be an object with keys of: " + keys},
      {R"({})", "needs exactly one of the keys: mesh, built_in"},
      {R"({"mesh": "mesh.obj", "built_in": "spheres"})", "needs exactly one of the keys: mesh, built_in"},
      {R"({"mesh": "mesh.obj", "light": []})", "unknown key \"light\"; allowed are: " + keys},
      {R"({"mesh": "mesh.obj", "mesh": "other.obj"})", "the key \"mesh\" stands twice in one object"},
      {R"({"mesh": 3})", "mesh: must be a string"},
      {R"({"mesh": "mesh.obj", "triangles": 7})",
       "a mesh file has the triangles it has; their number can be chosen for: " + scaling_names()},
      {R"({"built_in": "teapot"})", "built_in: there is no scene \"teapot\"; there are: " + built_in_names()},
      {R"({"built_in": "statue", "triangles": -1})", "triangles: must be a whole number of 0 to 4294967295"},
      {R"({"built_in": "statue", "triangles": 99})",
       "scene \"statue\": 99 triangles; allowed are 10000 to 50000000"},
      {R"({"mesh": "mesh.obj", "camera": []})",
       "camera: must be an object with keys of: eye, target, up, fov, projection"},
      {R"({"mesh": "mesh.obj", "camera": {"projection": "parallel"}})",
       "camera.projection: \"parallel\" is no projection; allowed are perspective and orthographic"},
      {R"({"mesh": "mesh.obj", "camera": {"projection": true}})", "camera.projection: must be a string"},
      {R"({"mesh": "mesh.obj", "camera": {"eye": [1, 2]}})", "camera.eye: must be an array of three numbers"},
      {R"({"mesh": "mesh.obj", "camera": {"eye": [1, 2, "3"]}})",
       "camera.eye[2]: must be a number that is finite"},
      {R"({"mesh": "mesh.obj", "camera": {"fov": 180}})",
       "camera.fov: 180 is out of range; allowed is more than 0 and less than 180"},
      {R"({"mesh": "mesh.obj", "lights": {}})", "lights: must be an array"},
      {R"({"mesh": "mesh.obj", "lights": [{}]})",
       "lights[0]: needs exactly one of the keys: position, direction"},
      {R"({"mesh": "mesh.obj", "lights": [{"position": [0, 0, 9], "direction": [0, 1, 0]}]})",
       "lights[0]: needs exactly one of the keys: position, direction"},
      {R"({"mesh": "mesh.obj", "lights": [{"direction": [0, 0, 0]}]})",
       "lights[0].direction: is zero; one number must differ from 0"},
      {R"({"mesh": "mesh.obj", "lights": [{"position": [0, 0, 9], "intensity": -1}]})",
       "lights[0].intensity: -1 is out of range; numbers must be none below 0"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {"albedo": 1.5}}})",
       "materials.m.albedo: 1.5 is out of range; numbers must be each in 0 to 1"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {"albedo": "red"}}})",
       "materials.m.albedo: must be one number or an array of three, each in 0 to 1"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {"albedo": 0.5, "reflect": [0.5, 0.75, 0]}}})",
       "materials.m: albedo, reflect and transmit add up to (1, 1.25, 0.5); at most 1 is allowed"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {"refractive_index": 0}}})",
       "materials.m.refractive_index: 0 is out of range; allowed is 0.1 to 10"},
      {R"({"mesh": "mesh.obj", "default_material": "m"})",
       "default_material: there is no material \"m\"; there are: none"},
      {R"({"mesh": "mesh.obj", "materials": {"a": {}, "b": {}}, "default_material": "m"})",
       "default_material: there is no material \"m\"; there are: a, b"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {}}, "assign": [{"material": "m"}]})",
       "assign[0]: needs exactly one of the keys: group, group_material, triangles"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {}}, "assign": [{"material": "m", "group": "roof"}]})",
       "assign[0].group: the mesh has no \"roof\"; it has: lower, middle, upper"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {}}, "assign": [{"material": "m", "triangles": [2, 5]}]})",
       "assign[0].triangles[1]: must be a whole number of 0 to 4"},
      {R"({"mesh": "mesh.obj", "materials": {"m": {}}, "assign": [{"material": "m", "triangles": [2, 1]}]})",
       "assign[0].triangles: the first triangle, 2, comes after the last, 1"},
  };
  for (const Wrong& wrong : all) rejected(wrong.text, wrong.message);
}

TEST_F(SceneFile, ThatIsNoJsonOrNoFileRejected) {
  const std::string file = write("{\"mesh\": \n}");
  const std::string message = message_of<std::exception>([&] { return read_scene_file(file); });
  EXPECT_EQ(message.find("scene file \"" + file + "\": is no JSON: parse error at line 2, column 1"), 0U)
      << message;
  EXPECT_EQ(message.find('\n'), std::string::npos);
  const std::string none = (folder_.path() / "none.json").string();
  EXPECT_EQ(message_of<std::exception>([&] { return load_scene(none); }),
            "scene file \"" + none + "\": no such file");
  const std::string mesh = (folder_.path() / "none.obj").string();
  rejected(R"({"mesh": "none.obj"})",
           "mesh file \"" + mesh + "\": no such file; give a .obj, .ply, .stl, .gltf or .glb file");
}

}  // namespace
}  // namespace hitpipe::ref::scene_file_test
