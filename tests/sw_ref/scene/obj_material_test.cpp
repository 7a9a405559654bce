// Materials of an OBJ file, as its MTL file defines them.
#include "sw_ref/scene/obj_material.hpp"

#include <string>

#include <gtest/gtest.h>

#include "tests/sim/temporary_folder.hpp"

namespace hitpipe::ref::obj_material_test {
namespace {

/// Five triangles: no material, red, mirror, glass, and a name that is not defined. If there is an MTL file,
/// Assimp takes some material of it for the first and the last.
constexpr const char* five_surfaces =
    "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 1 1 1\n"
    "f 1 2 5\nusemtl red\nf 1 2 3\nusemtl mirror\nf 1 2 4\nusemtl glass\nf 1 3 4\nusemtl unknown\nf 2 3 4\n";
constexpr const char* definitions =
    "newmtl red\nKd 0.8 0.1 0.2\nKs 0.5 0.5 0.5\nillum 2\n"
    "newmtl mirror\nKd 0.25 0.25 0.25\nKs 0.75 0.5 1.5\nillum 3\n"
    "newmtl glass\nKd 0.4 0.8 0.4\nd 0.25\nNi 1.5\nillum 6\n";

class ObjMaterials : public testing::Test {
 protected:
  [[nodiscard]] SceneDescription read(const std::string& mtl) const {
    folder_.write("mesh.mtl", mtl);
    return describe_scene(folder_.write("mesh.obj", five_surfaces).string());
  }
  static Material of(const SceneDescription& scene, std::size_t triangle) {
    return scene.materials.at(scene.mesh.materials.at(triangle));
  }

  const sim::TemporaryFolder folder_;
};

TEST_F(ObjMaterials, AreWhatTheMtlFileDefines) {
  const SceneDescription scene = read(definitions);
  ASSERT_EQ(scene.mesh.triangles.size(), 5U);
  // Highlights are no mirror.
  EXPECT_EQ(of(scene, 1).albedo, glm::vec3(0.8F, 0.1F, 0.2F));
  EXPECT_EQ(of(scene, 1).reflect, glm::vec3(0.0F));
  // Ks is cut to 1. The parts add up to 1.25 at most, so all are divided by that.
  EXPECT_EQ(of(scene, 2).albedo, glm::vec3(0.25F) / 1.25F);
  EXPECT_EQ(of(scene, 2).reflect, glm::vec3(0.75F, 0.5F, 1.0F) / 1.25F);
  EXPECT_EQ(of(scene, 3).albedo, 0.25F * glm::vec3(0.4F, 0.8F, 0.4F));
  EXPECT_EQ(of(scene, 3).transmit, glm::vec3(0.75F));
  EXPECT_EQ(of(scene, 3).refractive_index, 1.5F);
  // And the plain material of all meshes.
  EXPECT_EQ(scene.materials.size(), 4U);
  (void)place(scene);
}

TEST_F(ObjMaterials, WithoutAnMtlFileAreOnePlainMaterial) {
  const SceneDescription scene = describe_scene(folder_.write("mesh.obj", five_surfaces).string());
  EXPECT_EQ(scene.materials.size(), 1U);
  EXPECT_TRUE(scene.mesh.materials.empty());
}

TEST_F(ObjMaterials, LightThatGoesStraightOnHasNoIndex) {
  const SceneDescription scene = read("newmtl glass\nKd 1 1 1\nd 0.5\nNi 1.5\nillum 4\n");
  EXPECT_EQ(of(scene, 3).refractive_index, 1.0F);
  EXPECT_EQ(of(scene, 3).transmit, glm::vec3(0.5F));
}

TEST_F(ObjMaterials, OddNumbersStayInRange) {
  const SceneDescription scene =
      read("newmtl red\nKd -1 nan 1e30\nillum 2\nnewmtl glass\nKd 1 1 1\nd -3\nNi 0\nillum 6\n");
  for (std::size_t i = 0; i < 5; ++i) {
    const Material m = of(scene, i);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GE(m.albedo[k], 0.0F);
      EXPECT_LE(m.albedo[k] + m.reflect[k] + m.transmit[k], 1.0F);
    }
    EXPECT_GE(m.refractive_index, 0.1F);
  }
  (void)place(scene);
}

TEST_F(ObjMaterials, BeyondTheMostAllowedAreTheMostSimilar) {
  std::string mtl;
  std::string obj = "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n";
  for (int i = 0; i < 300; ++i) {
    const std::string name = "m" + std::to_string(i);
    mtl += "newmtl " + name + "\nKd " + std::to_string(i / 300.0) + " 0 0\n";
    obj += "v 0 0 " + std::to_string(i + 1) + "\nusemtl " + name + "\nf 1 2 " + std::to_string(i + 4) + "\n";
  }
  folder_.write("mesh.mtl", mtl);
  const SceneDescription scene = describe_scene(folder_.write("many.obj", obj).string());
  EXPECT_EQ(scene.materials.size(), 256U);
  ASSERT_EQ(scene.mesh.materials.size(), 300U);
  EXPECT_NEAR(of(scene, 100).albedo.x, 100 / 300.0, 1e-6);
  EXPECT_NEAR(of(scene, 299).albedo.x, 254 / 300.0, 1e-6);
}

TEST_F(ObjMaterials, ASceneFileMayReplaceThem) {
  folder_.write("mesh.mtl", definitions);
  folder_.write("mesh.obj", five_surfaces);
  const std::string file =
      folder_
          .write("my.json", R"({"mesh": "mesh.obj", "materials": {"dull": {"albedo": 0.25}},
    "assign": [{"material": "dull", "group_material": "red"}]})")
          .string();
  const SceneDescription scene = describe_scene(file);
  EXPECT_EQ(of(scene, 1).albedo, glm::vec3(0.25F));
  EXPECT_EQ(of(scene, 3).refractive_index, 1.5F);
}

}  // namespace
}  // namespace hitpipe::ref::obj_material_test
