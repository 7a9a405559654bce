// Morph targets and skins of glTF: where a mesh is that nothing animates.
#include "rays/files/gltf_skin.hpp"

#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rays/files/gltf_files.hpp"

namespace hitpipe::ref::gltf_skin_test {
namespace {

using nlohmann::json;

TEST(GltfSkin, MorphTargetsAreAddedWithTheirWeights) {
  json file = square_gltf();
  const std::size_t up = add_accessor(file, floats({0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4}), 5126, 4, "VEC3");
  file["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"NORMAL", up}}, {{"POSITION", 0}}};
  EXPECT_EQ(read(file).positions[3], glm::dvec3(1, 1, 0));
  file["meshes"][0]["weights"] = {0.5, 1, 0};
  EXPECT_EQ(read(file).positions[3], glm::dvec3(1, 1, 2));
  file["nodes"][0]["weights"] = {0.25, 0, 1};
  EXPECT_EQ(read(file).positions[3], glm::dvec3(2, 2, 1));
  file["nodes"][0]["weights"] = {1};
  EXPECT_EQ(reason(file), "meshes[0].primitives[0]: has 3 morph targets; the weights are 1");
}

/// Positions 0 and 1 are of joint 0, 2 of both, 3 of joint 1. The joints are at (1 0 0) and (0 0 8).
json skinned_gltf() {
  json file = square_gltf();
  json& attributes = file["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = add_accessor(
      file, little<std::uint8_t>({0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0}), 5121, 4, "VEC4");
  attributes["WEIGHTS_0"] =
      add_accessor(file, floats({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0, 1, 0, 0, 0}), 5126, 4, "VEC4");
  file["nodes"] = json::parse(R"([{"mesh": 0, "skin": 0, "translation": [100, 0, 0]},
    {"translation": [1, 0, 0]}, {"translation": [0, 0, 5], "children": [3]}, {"translation": [0, 0, 3]}])");
  file["scenes"][0]["nodes"] = {0, 1, 2};
  file["skins"] = json::parse(R"([{"joints": [1, 3]}])");
  return file;
}

TEST(GltfSkin, SkinsMoveMeshesByTheirJoints) {
  json file = skinned_gltf();
  EXPECT_EQ(read(file).positions, (std::vector<glm::dvec3>{{1, 0, 0}, {2, 0, 0}, {0.5, 1, 4}, {1, 1, 8}}));
  std::vector<float> inverse(32);
  for (const unsigned k : {0U, 5U, 10U, 15U, 16U, 21U, 26U, 31U}) inverse[k] = 1;
  inverse[12] = -1;
  inverse[30] = -8;
  file["skins"][0]["inverseBindMatrices"] = add_accessor(file, floats(inverse), 5126, 2, "MAT4");
  EXPECT_EQ(read(file).positions, read(square_gltf()).positions);
}

/// The node of the mesh says nothing here, and joints that differ say nothing about the whole.
TEST(GltfSkin, JointsThatAllMirrorSwapTwoCorners) {
  const json file = skinned_gltf();
  const std::vector<std::uint32_t> kept{0, 1, 2, 1, 3, 2};
  const std::vector<std::uint32_t> turned{0, 2, 1, 1, 2, 3};
  const auto corners = [&](const std::vector<std::vector<int>>& scales) {
    json changed = file;
    for (std::size_t node = 0; node < scales.size(); ++node) changed["nodes"][node]["scale"] = scales[node];
    return read(changed).corners;
  };
  EXPECT_EQ(corners({{-1, 1, 1}}), kept);
  EXPECT_EQ(corners({{1, 1, 1}, {-1, 1, 1}}), kept);
  EXPECT_EQ(corners({{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}}), turned);
  EXPECT_EQ(corners({{1, 1, 1}, {-1, 1, 1}, {1, -1, 1}, {1, 1, -1}}), kept);
  EXPECT_EQ(corners({{1, 1, 1}, {0, 1, 1}, {1, -1, 1}}), turned);
  json bound = file;
  std::vector<float> inverse(32);
  for (const unsigned k : {0U, 5U, 10U, 15U, 16U, 21U, 26U, 31U}) inverse[k] = k % 16 == 0 ? -1.0F : 1.0F;
  bound["skins"][0]["inverseBindMatrices"] = add_accessor(bound, floats(inverse), 5126, 2, "MAT4");
  EXPECT_EQ(read(bound).corners, turned);
  bound["nodes"][1]["scale"] = bound["nodes"][2]["scale"] = {-1, 1, 1};
  EXPECT_EQ(read(bound).corners, kept);
}

TEST(GltfSkin, FaultsOfSkinsAreRefused) {
  const json file = skinned_gltf();
  const auto with = [&](const std::string& place, const json& value) {
    json changed = file;
    changed[json::json_pointer(place)] = value;
    return reason(changed);
  };
  EXPECT_EQ(with("/skins/0/joints", {1}),
            "meshes[0].primitives[0]: vertex 2 has joint 1; the skin has 1 joints");
  EXPECT_EQ(with("/skins/0/joints", {1, 9}), "skins[0].joints[1]: must be a whole number of 0 to 3");
  EXPECT_EQ(with("/scenes/0/nodes", {0, 1}), "skins[0].joints[1]: node 3 is not in the scene that is read");
  EXPECT_EQ(with("/skins/0/joints", {1, 1, 1, 1, 3}), "skins[0].joints: has 5 joints; the file has 4 nodes");
  EXPECT_EQ(with("/nodes/0/skin", 1), "nodes[0].skin: must be a whole number of 0 to 0");
  EXPECT_EQ(
      with("/skins/0/inverseBindMatrices", 0),
      "accessors[0]: is for inverse matrices of 2 joints; it must have as many elements of type MAT4, 5126");
  EXPECT_EQ(with("/accessors/2/componentType", 5120),
            "accessors[2]: is for joints; it must be VEC4, 5121 or 5123");
  EXPECT_EQ(with("/accessors/3/componentType", 5125),
            "accessors[3]: is for weights; it must be VEC4, and 5126 or normalized");
  EXPECT_EQ(with("/meshes/0/primitives/0/attributes", {{"POSITION", 0}}),
            "meshes[0].primitives[0].attributes: needs the key \"JOINTS_0\"");
  json weightless = file;
  weightless["accessors"][3].erase("bufferView");
  EXPECT_EQ(reason(weightless),
            "meshes[0].primitives[0]: vertex 0 has joint weights of 0; they must add up to 1");
}

}  // namespace
}  // namespace hitpipe::ref::gltf_skin_test
