// Scenes, primitives and extensions of glTF, and one message for each fault.
#include "rays/files/gltf_reader.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/rays/files/gltf_files.hpp"

namespace hitpipe::ref::gltf_reader_test {
namespace {

using nlohmann::json;
using Corners = std::vector<std::uint32_t>;

TEST(ReadGltf, ModesAreTrianglesStripsAndFans) {
  const std::vector<std::pair<int, Corners>> modes{{4, {0, 1, 2, 1, 3, 2}},
                                                   {5, {0, 1, 2, 1, 1, 2, 2, 1, 3, 1, 2, 3}},
                                                   {6, {1, 2, 0, 2, 1, 0, 1, 3, 0, 3, 2, 0}}};
  for (const auto& [mode, corners] : modes) {
    json file = square_gltf();
    file["meshes"][0]["primitives"][0]["mode"] = mode;
    EXPECT_EQ(read(file).corners, corners);
  }
  for (int mode = 0; mode < 4; ++mode) {
    json file = square_gltf();
    file["meshes"][0]["primitives"][0]["mode"] = mode;
    EXPECT_EQ(read(file).faces(), 0U);
  }
  json bare = square_gltf();
  bare["meshes"][0]["primitives"][0]["attributes"] = json::object();
  EXPECT_EQ(read(bare).faces(), 0U);
  const std::string primitive = "/meshes/0/primitives/0";
  EXPECT_EQ(reason_with(primitive + "/mode", 7),
            "meshes[0].primitives[0].mode: must be a whole number of 0 to 6");
  EXPECT_EQ(reason_with("/accessors/1/count", 4),
            "meshes[0].primitives[0]: has 4 indices; mode 4 needs a multiple of 3");
  json strip = square_gltf();
  strip["meshes"][0]["primitives"][0]["mode"] = 5;
  strip["accessors"][1]["count"] = 2;
  EXPECT_EQ(reason(strip), "meshes[0].primitives[0]: has 2 indices; mode 5 needs 3 or more");
  EXPECT_EQ(reason_without(primitive, "indices"),
            "meshes[0].primitives[0]: has 4 positions; mode 4 needs a multiple of 3");
}

TEST(ReadGltf, IndicesOutOfRangeAreRefused) {
  EXPECT_EQ(reason_with("/accessors/0/count", 3),
            "meshes[0].primitives[0].indices: index 4 refers to vertex 3; the primitive has vertices 0 to 2");
  EXPECT_EQ(reason_with("/accessors/0/count", 0),
            "meshes[0].primitives[0].indices: index 0 refers to vertex 0; the primitive has no vertex");
}

TEST(ReadGltf, AttributesHaveAsManyElementsAsPositions) {
  json file = square_gltf();
  const std::size_t three = add_accessor(file, floats(std::vector<float>(9)), 5126, 3, "VEC3");
  json other = file;
  other["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = three;
  EXPECT_EQ(
      reason(other),
      "meshes[0].primitives[0].attributes.NORMAL: has 3 elements; POSITION has 4, and all must have as many");
  file["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", three}}};
  EXPECT_EQ(reason(file),
            "meshes[0].primitives[0].targets[0].POSITION: has 3 elements; POSITION has 4, and all must have "
            "as many");
}

TEST(ReadGltf, NodesMoveTheirMeshes) {
  json file = square_gltf();
  file["nodes"] = json::parse(R"([
    {"translation": [10, 0, 0], "children": [2, 1]}, {"mesh": 0, "matrix": [0,2,0,0, -2,0,0,0, 0,0,2,0, 0,0,5,1]},
    {"rotation": [0, 0, 0.7071068, 0.7071068], "scale": [1, 3, 1], "translation": [0, 0, 0.1], "children": [3]},
    {"mesh": 0, "scale": [-1, 1, 1]}, {"mesh": 0}])");
  const FileMesh mesh = read(file);
  ASSERT_EQ(mesh.faces(), 4U);
  ASSERT_EQ(mesh.positions.size(), 8U);
  EXPECT_NEAR(mesh.positions[3].x, 10 - 3, 1e-15);
  EXPECT_NEAR(mesh.positions[3].y, -1, 1e-15);
  EXPECT_EQ(mesh.positions[3].z, 0.1);
  EXPECT_EQ(mesh.positions[7], glm::dvec3(8, 2, 5));
  EXPECT_EQ(mesh.corners, (Corners{0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6}));
}

TEST(ReadGltf, TransformsThatMirrorSwapTwoCorners) {
  json file = square_gltf();
  const auto turned = [&](const char* above, const char* own) {
    file["nodes"] = {json::parse(above), json::parse(own)};
    file["nodes"][0]["children"] = {1};
    file["nodes"][1]["mesh"] = 0;
    const Corners corners = read(file).corners;
    EXPECT_TRUE(corners == (Corners{0, 1, 2, 1, 3, 2}) || corners == (Corners{0, 2, 1, 1, 2, 3}));
    return corners[1] == 2;
  };
  const char* const mirror = R"({"scale": [-1, 1, 1]})";
  for (const char* const node :
       {mirror, R"({"scale": [-2, -3, -4]})", R"({"scale": [1e-150, -1e-150, 1e-150]})",
        R"({"rotation": [0.6, 0, 0, 0.8], "scale": [1, 1, -1], "translation": [1, 2, 3]})",
        R"({"matrix": [0,1,0,0, 1,0,0,0, 0,0,1,0, 5,5,5,1]})",
        R"({"matrix": [1e-150,0,0,0, 0,-1e-150,0,0, 0,0,1e-150,0, 0,0,0,1]})"}) {
    EXPECT_TRUE(turned("{}", node)) << node;
    EXPECT_TRUE(turned(node, "{}")) << node;
    EXPECT_FALSE(turned(node, mirror)) << node;
  }
  for (const char* const node :
       {R"({"scale": [-1, -1, 1]})", R"({"scale": [-1, 1, 0]})", R"({"scale": [-1, 1, -0.0]})",
        R"({"matrix": [-1,0,0,0, 0,-1,0,0, 0,0,1,0, 0,0,0,1]})",
        R"({"matrix": [0.1,0.2,0.3,0, 0.3,0.6,0.9,0, -1,0,0,0, 0,0,0,1]})"})
    EXPECT_FALSE(turned("{}", node)) << node;
  EXPECT_FALSE(
      turned(R"({"rotation": [0.6, 0, 0, 0.8], "scale": [-1, 1, 0]})", R"({"rotation": [0, 0.6, 0, 0.8]})"));
  file["nodes"] = json::array({json::parse(mirror)});
  file["nodes"][0]["mesh"] = 0;
  json& primitive = file["meshes"][0]["primitives"][0];
  primitive["mode"] = 5;
  EXPECT_EQ(read(file).corners, (Corners{0, 2, 1, 1, 2, 1, 2, 3, 1, 1, 3, 2}));
  primitive["mode"] = 6;
  primitive.erase("indices");
  EXPECT_EQ(read(file).corners, (Corners{1, 0, 2, 2, 0, 3}));
}

TEST(ReadGltf, PositionsThatNoTriangleUsesAreNotRead) {
  json file = square_gltf();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  file["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
      add_accessor(file, floats({0, 0, 0, 1, 0, 0, 0, 1, 0, nan, 0, 0}), 5126, 4, "VEC3");
  file["accessors"][1]["count"] = 3;
  EXPECT_EQ(read(file).corners, (Corners{0, 1, 2}));
  file["accessors"][1]["count"] = 6;
  EXPECT_EQ(reason(file),
            "meshes[0].primitives[0]: vertex 3 lies at (nan, 0, 0); coordinates must be finite");
  file["meshes"][0]["primitives"][0]["indices"] =
      add_accessor(file, little<std::uint16_t>({0, 1, 2, 2, 1, 0}), 5123, 6, "SCALAR");
  EXPECT_EQ(read(file).corners, (Corners{0, 1, 2, 2, 1, 0}));
}

TEST(ReadGltf, SceneIsTheNamedOneElseTheFirstElseAllNodes) {
  json file = square_gltf();
  file["nodes"] = json::parse(R"([{"mesh": 0}, {"mesh": 0, "translation": [1, 0, 0], "children": [2]},
                                  {"mesh": 0}, {"mesh": 0, "translation": [0, 0, 9]}])");
  file["scenes"] = json::parse(R"([{"nodes": [3]}, {"nodes": [1, 0]}, {}])");
  EXPECT_EQ(read(file).positions[0], glm::dvec3(0, 0, 9));
  file["scene"] = 1;
  const FileMesh second = read(file);
  EXPECT_EQ(second.faces(), 6U);
  EXPECT_EQ(second.positions[0], glm::dvec3(1, 0, 0));
  EXPECT_EQ(second.positions[8], glm::dvec3(0, 0, 0));
  file["scene"] = 2;
  EXPECT_EQ(read(file).faces(), 0U);
  file.erase("scene");
  EXPECT_EQ(read(file).faces(), 2U);
  file.erase("scenes");
  EXPECT_EQ(read(file).faces(), 8U);
  file["scene"] = 0;
  EXPECT_EQ(reason(file), "scene: must name one of scenes, of which the file has none");
}

TEST(ReadGltf, NodesMustBeTrees) {
  json file = square_gltf();
  const auto reason_of = [&](const char* nodes, const char* roots = "[0]") {
    file["nodes"] = json::parse(nodes);
    file["scenes"][0]["nodes"] = json::parse(roots);
    return reason(file);
  };
  EXPECT_EQ(reason_of(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])"),
            "nodes[1].children[0]: node 2 is a child of node 0 too; a node has one parent");
  EXPECT_EQ(reason_of(R"([{"children": [1, 1]}, {"mesh": 0}])"),
            "nodes[0].children[1]: node 1 is a child of node 0 too; a node has one parent");
  EXPECT_EQ(reason_of(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])"),
            "nodes[1]: is below itself; nodes must be trees");
  EXPECT_EQ(reason_of(R"([{"children": [0]}])"), "nodes[0]: is below itself; nodes must be trees");
  EXPECT_EQ(reason_of(R"([{"children": [1]}, {"mesh": 0}])", "[0, 1]"),
            "scenes[0].nodes[1]: node 1 is a child of node 0; a scene has nodes without parent");
  EXPECT_EQ(reason_of(R"([{"mesh": 0}])", "[0, 0]"),
            "scenes[0].nodes[1]: node 0 is in the scene twice; it may be once");
  EXPECT_EQ(reason_of(R"([{"children": [5]}])"), "nodes[0].children[0]: must be a whole number of 0 to 0");
  EXPECT_EQ(reason_of("[7]"), "nodes[0]: must be an object");
  EXPECT_EQ(reason_of(R"([{"mesh": 1}])"), "nodes[0].mesh: must be a whole number of 0 to 0");
}

TEST(ReadGltf, TransformsAreChecked) {
  EXPECT_EQ(reason_with("/nodes/0/rotation", {0, 0, 0, 2}),
            "nodes[0].rotation: has the length 2; a quaternion must have the length 1");
  EXPECT_EQ(reason_with("/nodes/0/scale", {1, 2}), "nodes[0].scale: must be an array of three numbers");
  EXPECT_EQ(reason_with("/nodes/0/matrix", {1, 2}), "nodes[0].matrix: must be an array of 16 numbers");
  EXPECT_EQ(reason_with("/nodes/0/matrix", {1, 0, 0, 1, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}),
            "nodes[0].matrix: has no 0, 0, 0, 1 in its last row; allowed are matrices without perspective");
  json both = square_gltf();
  both["nodes"][0] =
      json::parse(R"({"mesh": 0, "scale": [1,1,1], "matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]})");
  EXPECT_EQ(reason(both),
            "nodes[0]: has a matrix, and also translation, rotation or scale; only one of both is allowed");
  json far = square_gltf();
  far["nodes"] =
      json::parse(R"([{"children": [1], "scale": [1e300,1,1]}, {"mesh": 0, "scale": [1e300,1,1]}])");
  EXPECT_EQ(
      reason(far),
      "meshes[0].primitives[0]: a node transform moves vertex 0 to (-nan, 0, 0); coordinates must be finite");
}

TEST(ReadGltf, PositionsMustBeFinite) {
  json file = square_gltf();
  file["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = add_accessor(
      file, little<std::uint32_t>({0, 0, 0, 0, 0x7F800000U, 0, 0, 0, 0, 0, 0, 0}), 5126, 4, "VEC3");
  EXPECT_EQ(reason(file),
            "meshes[0].primitives[0]: vertex 1 lies at (0, inf, 0); coordinates must be finite");
}

TEST(ReadGltf, ChainOfManyNodesIsRead) {
  json file = square_gltf();
  file["nodes"] = json::array();
  for (int n = 1; n < 20000; ++n) file["nodes"].push_back({{"children", {n}}, {"translation", {0.5, 0, 0}}});
  file["nodes"].push_back({{"mesh", 0}});
  EXPECT_EQ(read(file).positions[0], glm::dvec3(9999.5, 0, 0));
}

TEST(ReadGltf, GroupsAreThePrimitivesOfEachNode) {
  json file = square_gltf();
  file["materials"] = json::parse(R"([{}, {"name": "red"}])");
  json& primitives = file["meshes"][0]["primitives"];
  primitives.push_back(primitives[0]);
  primitives.push_back(primitives[0]);
  primitives[0]["material"] = 1;
  primitives[1]["mode"] = 1;
  primitives[2]["material"] = 0;
  file["nodes"].push_back({{"mesh", 0}});
  file["scenes"][0]["nodes"] = {1, 0};
  const FileMesh mesh = read(file);
  ASSERT_EQ(mesh.groups.size(), 4U);
  for (std::size_t g = 0; g < 4; ++g) {
    EXPECT_EQ(mesh.groups[g].name, "square");
    EXPECT_EQ(mesh.groups[g].material, g % 2 == 0 ? "red" : "");
    EXPECT_EQ(mesh.groups[g].first_face, 2 * g);
  }
}

TEST(ReadGltf, RequiredExtensionsMustBeKnown) {
  for (const char* const name : {"KHR_draco_mesh_compression", "EXT_meshopt_compression",
                                 "VENDOR_other_geometry", "KHR_node_visibility", "KHR_materials"})
    EXPECT_EQ(reason_with("/extensionsRequired", {"KHR_materials_unlit", name}),
              "extensionsRequired[1]: the extension \"" + std::string(name) +
                  "\" is not read; give a file that does not require it");
  json file = square_gltf();
  file["extensionsRequired"] = {"KHR_mesh_quantization", "EXT_mesh_gpu_instancing", "KHR_materials_ior",
                                "KHR_texture_transform", "EXT_texture_webp"};
  EXPECT_EQ(read(file).faces(), 2U);
}

TEST(ReadGltf, ExtensionsThatChangeWhatIsSeenAreRefused) {
  EXPECT_EQ(reason_with("/nodes/0/extensions", {{"KHR_node_visibility", {{"visible", false}}}}),
            "nodes[0].extensions.KHR_node_visibility: hidden nodes are not read; give a file without them");
  json draco = square_gltf();
  draco["meshes"][0]["primitives"][0]["extensions"]["KHR_draco_mesh_compression"] = json::object();
  EXPECT_EQ(read(draco).faces(), 2U);
  draco["accessors"][0].erase("bufferView");
  EXPECT_EQ(reason(draco),
            "meshes[0].primitives[0]: has positions in KHR_draco_mesh_compression alone, which is not read; "
            "give plain "
            "ones");
}

TEST(ReadGltf, OtherVersionsAreRefusedByName) {
  EXPECT_EQ(reason_with("/asset/version", "1.0"), "glTF 1.0 is not read; allowed is 2.0");
  EXPECT_EQ(reason_with("/asset/version", 1), "glTF 1.0 is not read; allowed is 2.0");
  EXPECT_EQ(reason_with("/asset/version", "3.0"), "asset.version: \"3.0\" is not read; allowed is 2.0");
  EXPECT_EQ(reason_with("/asset/version", ""), "asset.version: \"\" is not read; allowed is 2.0");
  EXPECT_EQ(reason_with("/asset/minVersion", "2.1"), "asset.minVersion: \"2.1\" is not read; allowed is 2.0");
  EXPECT_EQ(reason_without("", "asset"), "needs the key \"asset\"");
  EXPECT_EQ(reason_without("/asset", "version"), "asset: needs the key \"version\"");
}

TEST(ReadGltf, TextThatIsNoJsonIsRefused) {
  const auto reason_of = [](const std::string& text) {
    return message_of([&] { static_cast<void>(read_gltf(text, "m.gltf")); });
  };
  EXPECT_EQ(
      reason_of("OFF"),
      "is no JSON: parse error at line 1, column 1: syntax error while parsing value - invalid literal; last "
      "read: 'O'");
  EXPECT_EQ(reason_of("[]"), "the JSON must be an object");
  EXPECT_EQ(reason_of("{\"a\":1,\"a\":2}"), "the key \"a\" stands twice in one object");
  EXPECT_EQ(reason_of(std::string(1000000, '[')),
            "arrays and objects lie more than 1000 deep in one another");
}

TEST(ReadGltf, InstancesMayNotTakeAnyMemory) {
  json file = square_gltf();
  file["accessors"][0] = {
      {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}};  // zeros, without a buffer
  file["accessors"][1] = {{"componentType", 5125}, {"count", 3000000}, {"type", "SCALAR"}};
  const auto expected = [](const std::string& node, std::uint64_t bytes, std::uint64_t size) {
    return node + ": with its mesh the scene needs " + std::to_string(bytes) + " bytes; allowed are " +
           std::to_string((32U << 20U) + 24 * size) + ", which is 32 MiB and 24 times the bytes of the file";
  };
  EXPECT_EQ(read(file).faces(), 1000000U);
  for (int n = 0; n < 3; ++n) file["nodes"].push_back({{"mesh", 0}});
  file["scenes"][0]["nodes"] = {0, 1, 2, 3};
  const std::uint64_t instance = 12000000 + 72 + 6 + sizeof(FileMesh::Group);
  EXPECT_EQ(reason(file), expected("nodes[2]", 3 * instance, file.dump().size()));
  file["accessors"][1]["count"] = 4294967292U;
  EXPECT_EQ(reason(file),
            expected("nodes[0]", instance - 12000000 + 4 * std::uint64_t{4294967292}, file.dump().size()));
}

}  // namespace
}  // namespace hitpipe::ref::gltf_reader_test
